"""Records of solved cases as one table, and tables of cases as records."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import groupby
from typing import Any

import numpy as np
import pandas as pd

from nptcs.campaign.bulk_file import read_bulk
from nptcs.campaign.record import CaseRecord, read_records
from nptcs.solvers.contract import SolverResult
from nptcs.solvers.tables import CURVE, curve_of
from nptcs.tables.status import has_result
from nptcs.tables.tyres.cases import RESPONSES, realised_column

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
    """Read batch files, whether of records or of tables, as the table `Cases`.

    Cases of a study are in the order of its design, whatever the number of batches
    (`nptcs.campaign.record.read_records`).

    Raises
    ------
    InputError
        For a file that was damaged or edited.
    """
    records = read_records([path for path in paths if not path.endswith(BULK)])
    in_bulk = groupby([path for path in paths if path.endswith(BULK)], key=os.path.dirname)
    tables = [_in_turn([_without_curves(read_bulk(path)) for path in part]) for _, part in in_bulk]
    if records or not tables:
        tables = [cases_table(records), *tables]
    joined = pd.concat(tables, ignore_index=True)
    # factors of all studies come before the load and the responses, as in a table of records
    return joined[_in_order(tables)]


def _in_turn(tables: Sequence[pd.DataFrame]) -> pd.DataFrame:
    """Join the tables of batches, taking one row from each in turn."""
    places = [number + len(tables) * np.arange(len(table)) for number, table in enumerate(tables)]
    order = np.argsort(np.concatenate(places))
    return pd.concat(tables, ignore_index=True).iloc[order].reset_index(drop=True)


def _without_curves(table: pd.DataFrame) -> pd.DataFrame:
    return table[[name for name in table if not str(name).startswith(CURVE)]]


def read_tyres(paths: Sequence[str]) -> list[CaseRecord]:
    """Read the solved tyres with a load–displacement curve, from records and from tables.

    Parameters
    ----------
    paths : sequence of str
        Batch files.

    Returns
    -------
    list of CaseRecord
        All records, and the solved rows of tables that have a curve. A table keeps neither
        neutral lines nor the stress of plates.

    Raises
    ------
    InputError
        For a file that was damaged or edited.
    """
    records = read_records([path for path in paths if not path.endswith(BULK)])
    tables = [read_bulk(path) for path in paths if path.endswith(BULK)]
    return [*records, *(record for table in tables for record in _tyres(table))]


def _tyres(table: pd.DataFrame) -> Iterator[CaseRecord]:
    names = [str(name) for name in table]
    factors = names[5 : names.index("load_n")]
    results = names[names.index("load_n") + 1 : names.index("wall_time_s")]
    for values in table[has_result(table["status"])].to_numpy(dtype=object):
        row = dict(zip(names, values, strict=True))
        curve = curve_of({name: row[name] for name in results if name.startswith(CURVE)})
        if curve is None:
            continue
        given = {name: value for name, value in row.items() if pd.notna(value)}
        yield CaseRecord(
            **{name: row[name] for name in ("study", "case_id", "solver", "solver_version", "key")},
            values=_of(factors, given),
            load_n=row["load_n"],
            wall_time_s=row["wall_time_s"],
            result=SolverResult(
                status=row["status"],
                message=row["message"],
                curve=curve,
                **_results(results, given),
            ),
        )


def _results(names: Sequence[str], given: Mapping[str, Any]) -> dict[str, Any]:
    """Sort the results of a row, without its curve, as `SolverResult` holds them."""
    prefix = realised_column("")
    realised = [name for name in names if name.startswith(prefix)]
    extra = [name for name in names if name not in (*RESPONSES, *realised)]
    return {
        **_of(RESPONSES, given),
        "realised": {name.removeprefix(prefix): given[name] for name in realised if name in given},
        "extra": _of([name for name in extra if not name.startswith(CURVE)], given),
    }


def _of(names: Iterable[str], given: Mapping[str, Any]) -> dict[str, Any]:
    return {name: given[name] for name in names if name in given}


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
