"""All tables that are made of the specimens' properties, by the output that they go to."""

from __future__ import annotations

from collections.abc import Sequence

import pandas as pd
import pandera.pandas as pa

from nptcs.config.materials.reduction import ReductionSettings
from nptcs.reduce.groups.flag_groups import group_flags
from nptcs.reduce.groups.statistics import group_statistics
from nptcs.tables.laboratory.flags import FlagsTable
from nptcs.tables.laboratory.properties import PropertiesTable
from nptcs.tables.laboratory.specimens import Specimen
from nptcs.tables.laboratory.statistics import StatisticsTable


def result_tables(
    properties: pd.DataFrame, specimens: Sequence[Specimen], settings: ReductionSettings
) -> dict[str, tuple[pd.DataFrame, type[pa.DataFrameModel]]]:
    """Return properties, flags and statistics of all specimens, each with its contract.

    Parameters
    ----------
    properties : DataFrame
        `PropertiesTable` of all series.
    specimens : sequence of Specimen
        The sheet, repeated data counted once.
    settings : ReductionSettings
    """
    return {
        "specimens": (properties, PropertiesTable),
        "flags": (group_flags(properties, settings), FlagsTable),
        "statistics": (group_statistics(properties, specimens, settings), StatisticsTable),
    }
