"""Records of solved cases as one table."""

from __future__ import annotations

from collections.abc import Sequence

import pandas as pd

from nptcs.campaign.bulk_file import read_bulk
from nptcs.campaign.record import CaseRecord, read_records
from nptcs.tables.cases import RESPONSES, realised_column

BULK = ".npz"
"""Ending of a file with the results of a whole table of cases."""


def cases_table(records: Sequence[CaseRecord]) -> pd.DataFrame:
    """Write records as the table `Cases`.

    Parameters
    ----------
    records : sequence of CaseRecord
        Of any number of studies and solvers.

    Returns
    -------
    DataFrame
        ``study, case_id, solver, status, message``, the factors and fixed values of all studies,
        ``load_n``, ``realised_FACTOR`` for each factor for which a solver reports the value that it
        actually used (empty: the given one), the responses, whatever else solvers report, and where
        each row came from.
    """
    values = list(dict.fromkeys(name for record in records for name in record.values))
    extra = list(dict.fromkeys(name for record in records for name in record.result.extra))
    realised = list(dict.fromkeys(name for record in records for name in record.result.realised))
    rows = [
        {
            "study": record.study,
            "case_id": record.case_id,
            "solver": record.solver,
            "status": record.result.status.value,
            "message": record.result.message,
            **{name: record.values.get(name) for name in values},
            "load_n": record.load_n,
            **{realised_column(name): record.result.realised.get(name) for name in realised},
            **{name: getattr(record.result, name) for name in RESPONSES},
            **{name: record.result.extra.get(name) for name in extra},
            "wall_time_s": record.wall_time_s,
            "solver_version": record.solver_version,
            "key": record.key,
        }
        for record in records
    ]
    table = pd.DataFrame(rows)
    numbers = [*values, "load_n", *map(realised_column, realised), *RESPONSES, *extra]
    table[numbers] = table[numbers].astype(float)
    return table


def read_cases(paths: Sequence[str]) -> pd.DataFrame:
    """Read batch files, of records and of tables, as the table `Cases`.

    Raises
    ------
    InputError
        For a file that was damaged or edited.
    """
    records = read_records([path for path in paths if not path.endswith(BULK)])
    tables = [read_bulk(path) for path in paths if path.endswith(BULK)]
    if records or not tables:
        tables = [cases_table(records), *tables]
    joined = pd.concat(tables, ignore_index=True)
    # factors of all studies come before the load and the responses, as in a table of records
    return joined[_in_order(tables)]


def _in_order(tables: Sequence[pd.DataFrame]) -> list[str]:
    """Order the columns of several tables of cases: each group as in `cases_table`."""
    groups: list[list[str]] = [[], [], []]
    for table in tables:
        names = [str(name) for name in table]
        load = names.index("load_n")
        end = names.index("wall_time_s")
        for group, part in zip(groups, (names[:load], names[load:end], names[end:]), strict=True):
            group += [name for name in part if name not in group]
    return [name for group in groups for name in group]
