"""The statistics table: one row per group of specimens and property."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import pandas as pd

from nptcs.config.materials.reduction import ReductionSettings
from nptcs.errors import InputError
from nptcs.mechanical_tests import TestType
from nptcs.reduce.deviations import CROSSHEAD, with_crosshead_strain
from nptcs.reduce.groups.counted import GROUP, counted, left_out, why_not
from nptcs.reduce.groups.pooling import pooled_rows
from nptcs.reduce.groups.sample import describe_sample
from nptcs.reduce.rows import TEST_CONDITIONS
from nptcs.tables.laboratory.specimens import Specimen
from nptcs.tables.laboratory.statistics import StatisticsTable

NOT_CORRECTED = "preload and toe not corrected"
"""Flag of the ingest where too few readings or a poor fit left the origin as it was."""


def group_statistics(
    properties: pd.DataFrame, specimens: Sequence[Specimen], settings: ReductionSettings
) -> pd.DataFrame:
    """Statistics of each property over the specimens of a test, material and orientation.

    Parameters
    ----------
    properties : DataFrame
        `nptcs.tables.laboratory.properties.PropertiesTable`.
    specimens : sequence of Specimen
        The sheet: a specimen with include = no stays in `properties` but is left out here,
        with its reason in the column ``left_out``; so does a property that the sheet takes from
        another run. Runs of one piece count once.
    settings : ReductionSettings
        Standards (for the number of specimens that they require) and statistics.

    Returns
    -------
    DataFrame
        `nptcs.tables.laboratory.statistics.StatisticsTable`: one row per group, then the pooled
        rows.

    Raises
    ------
    InputError
        If a property belongs to a specimen that the sheet does not name.
    """
    sheet = _sheet(properties, specimens)
    rows = []
    for key, group in properties.groupby(GROUP, dropna=False, sort=False):
        included = counted(group, sheet)
        rules = settings.rules(TestType(str(key[0])))
        row = {
            **dict(zip(GROUP, key, strict=True)),
            **_words(group, included),
            "left_out": left_out(group, sheet),
            "group_size": len(included),
            "not_assessed": _not_assessed(included),
            "scope": "group",
            "reported_statistic": rules.reported_statistic,
        }
        measured = included[included["value"].notna()]
        numbers, notes = describe_sample(
            measured["value"].to_numpy(),
            measured["specimen"].tolist(),
            settings.statistics,
            allowable=key[3] not in TEST_CONDITIONS,
        )
        notes = [*_number_notes(measured, included, rules.minimum_specimens, rules.title), *notes]
        rows.append({**row, **numbers, "notes": "; ".join(notes)})
    rows += pooled_rows(properties, sheet, settings.statistics)
    return StatisticsTable.validate(pd.DataFrame(rows)[list(StatisticsTable.to_schema().columns)])


def _sheet(properties: pd.DataFrame, specimens: Sequence[Specimen]) -> dict[str, Specimen]:
    sheet = {s.specimen: s for s in specimens}
    for name in properties["specimen"].unique():
        if name not in sheet:
            raise InputError(
                "has properties but no row in the specimen sheet",
                "add its row, or rebuild the property table",
                specimen=str(name),
            )
    return sheet


def _words(group: pd.DataFrame, included: pd.DataFrame) -> dict[str, str]:
    """Return unit, rule and range of a group; several of them are joined with ' | '."""
    source = included if len(included) else group
    return {name: _joined(source[name]) for name in ("unit", "rule", "range")}


def _joined(texts: Iterable[str]) -> str:
    return " | ".join(dict.fromkeys(text for text in texts if text))


def _not_assessed(included: pd.DataFrame) -> str:
    """Name the specimens of a group without a value, and why."""
    lacking = included[included["value"].isna()]
    names = zip(lacking["specimen"], lacking["flags"], strict=True)
    return "; ".join(f"{name}: {why_not(flags)}" for name, flags in names)


def _number_notes(
    measured: pd.DataFrame, included: pd.DataFrame, asked: int, title: str
) -> list[str]:
    notes = []
    if len(measured) < len(included):
        lacking = included.loc[included["value"].isna(), "specimen"]
        notes.append(f"assessed: {len(measured)} of {len(included)}")
        notes.append("not assessed: " + ", ".join(lacking))
    if len(measured) < asked:
        notes.append(f"n = {len(measured)}, {title} requires {asked}")
    if len(set(measured["range"])) > 1:
        notes.append("ranges differ between specimens")
    raw = measured.loc[measured["flags"].str.contains(NOT_CORRECTED, regex=False), "specimen"]
    if 0 < len(raw) < len(measured):
        notes.append(f"preload and toe corrected in the others, not in {', '.join(raw)}")
    crosshead = with_crosshead_strain(measured)
    if crosshead:
        notes.append(f"{CROSSHEAD}: {', '.join(crosshead)}")
    flagged = list(measured.loc[measured["flags"] != "", "specimen"])
    if flagged:
        notes.append("flagged: " + ", ".join(flagged))
    return notes
