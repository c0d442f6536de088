"""The curves of one series of specimens reduced, each by the standard of its test."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import pandas as pd

from nptcs.config.materials.ingest import Plausible
from nptcs.config.materials.reduction import ReductionSettings
from nptcs.errors import InputError
from nptcs.reduce.specimen import reduce_record
from nptcs.tables.io import empty_table
from nptcs.tables.laboratory.curves import IngestRecord
from nptcs.tables.laboratory.properties import PropertiesTable
from nptcs.tables.laboratory.specimens import Specimen
from nptcs.tables.problems import problems_table


def reduce_series(
    specimens: Sequence[Specimen],
    curves: Mapping[str, pd.DataFrame],
    records: Mapping[str, IngestRecord],
    settings: ReductionSettings,
    plausible: Plausible,
) -> tuple[pd.DataFrame, pd.DataFrame]:
    """Reduce the specimens that could be read; one that cannot be reduced becomes a problem.

    Parameters
    ----------
    specimens : sequence of Specimen
        Rows of the specimen sheet.
    curves : mapping of str to DataFrame
        `nptcs.tables.laboratory.curves.Curve` by specimen.
    records : mapping of str to IngestRecord
        How each curve was made; one that failed is skipped here: it is a problem of the stage
        ``ingest``.
    settings : ReductionSettings
        The section ``reduction`` of the configuration.
    plausible : Plausible
        Limits for a reported value, the same as for the curve.

    Returns
    -------
    properties : DataFrame
        `PropertiesTable` of all specimens that were reduced.
    problems : DataFrame
        `nptcs.tables.problems.Problems` of the others.
    """
    tables, problems = [], []
    for specimen in specimens:
        name = specimen.specimen
        record = records[name]
        if not record.understood:
            continue
        try:
            tables.append(reduce_record(curves[name], specimen, record, settings, plausible))
        except InputError as error:
            problems.append(("reduce", name, "", "error", str(error)))
    properties = pd.concat(tables) if tables else empty_table(PropertiesTable)
    return properties, problems_table(problems)
