"""Flags of all specimens collected: which deviations there are, and which specimens have them."""

from __future__ import annotations

import re
from collections.abc import Sequence

import pandas as pd

from nptcs.config.materials.reduction import ReductionSettings
from nptcs.mechanical_tests import TestType
from nptcs.reduce.deviations import CROSSHEAD
from nptcs.reduce.groups.counted import NOT_ASSESSED
from nptcs.tables.laboratory.flags import FLAG_KINDS, FlagsTable

NUMBER = re.compile(r"(?<![\w.-])[-+]?\d+(?:\.\d+)?(?:e[-+]?\d+)?")
WITHOUT_TITLE = (CROSSHEAD, "source of the strain not stated", " stations", "not given, area:")
"""Parts of the deviations of `nptcs.reduce.deviations` that do not name their standard."""


def group_flags(properties: pd.DataFrame, settings: ReductionSettings) -> pd.DataFrame:
    """Collect the flags of the properties, as `FlagsTable`.

    Parameters
    ----------
    properties : DataFrame
        `nptcs.tables.laboratory.properties.PropertiesTable` of all specimens.
    settings : ReductionSettings
        Says which standard is in force for a test.

    Returns
    -------
    DataFrame
        Deviations first, those of most specimens first.
    """
    titles = {test: settings.rules(TestType(test)).title for test in properties["test"].unique()}
    single = properties[["specimen", "test", "property", "flags"]].assign(
        standard=properties["test"].map(titles), flag=properties["flags"].str.split("; ")
    )
    single = single.explode("flag")
    single = single[single["flag"].fillna("") != ""]
    single["form"] = [NUMBER.sub("#", flag) for flag in single["flag"]]
    rows = [
        (
            standard,
            flag_kind(rows["flag"].iloc[0], str(standard)),
            with_ranges(list(dict.fromkeys(rows["flag"]))),
            rows["specimen"].nunique(),
            ", ".join(rows["specimen"].unique()),
            ", ".join(rows["property"].unique()),
        )
        for (standard, _), rows in single.groupby(["standard", "form"], sort=False)
    ]
    table = pd.DataFrame(rows, columns=list(FlagsTable.to_schema().columns))
    place = table["kind"].map(FLAG_KINDS.index)
    table = table.assign(place=place, most=-table["specimens"])
    return table.sort_values(["place", "most"], kind="stable", ignore_index=True).drop(
        columns=["place", "most"]
    )


def flag_kind(flag: str, standard: str) -> str:
    """Return one of `FLAG_KINDS`."""
    if flag.startswith(NOT_ASSESSED):
        return "not assessed"
    deviates = standard in flag or any(part in flag for part in WITHOUT_TITLE)
    return "deviation" if deviates else "remark"


def with_ranges(flags: Sequence[str]) -> str:
    """Write flags that differ in their numbers as one.

    Examples
    --------
    >>> with_ranges(["failure after 0.95 min of 1 to 10", "failure after 0.98 min of 1 to 10"])
    'failure after 0.95 to 0.98 min of 1 to 10'
    """
    columns = zip(*(NUMBER.findall(flag) for flag in flags), strict=True)
    texts = iter([_range(numbers) for numbers in columns])
    return NUMBER.sub(lambda _: next(texts), flags[0])


def _range(numbers: Sequence[str]) -> str:
    low, high = min(numbers, key=float), max(numbers, key=float)
    return low if float(low) == float(high) else f"{low} to {high}"
