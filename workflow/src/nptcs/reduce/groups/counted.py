"""Which values count: those of the runs that the sheet names for them, once for each piece."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
import pandas as pd

from nptcs.reduce.curve.evidence import UNRECORDED
from nptcs.reduce.deviations import CROSSHEAD
from nptcs.tables.laboratory.specimens import Specimen

GROUP = ["test", "material", "orientation_deg", "property"]
NOT_ASSESSED = "not assessed: "
WITHOUT_STRAIN = ("strength", "flexural_strength", "time_to_failure")
"""Properties that need no strain, so its source does not matter."""
TRAVEL_NEXT_TO_SENSORS = (
    f"{NOT_ASSESSED}{CROSSHEAD}, where other specimens of the group have a sensor"
)


def counted(properties: pd.DataFrame, sheet: Mapping[str, Specimen]) -> pd.DataFrame:
    """Rows of a property table that enter statistics and cards, one for each piece.

    A row counts if the sheet includes its specimen and takes the property from this run. A value
    whose failure no reading shows is emptied: it is not assessed for any mean. So is one from
    crosshead travel where another specimen of the group has a sensor. Runs that give the same
    property of the same piece count once, with the mean of their values.

    Parameters
    ----------
    properties : DataFrame
        `nptcs.tables.laboratory.properties.PropertiesTable`.
    sheet : mapping of str to Specimen
        Rows of the specimen sheet by id.

    Returns
    -------
    DataFrame
        The same columns; ``specimen`` is the piece where the sheet names one.
    """
    pairs = zip(properties["specimen"], properties["property"], strict=True)
    rows = properties[[sheet[specimen].gives(name) for specimen, name in pairs]]
    rows = of_sensors(_recorded(rows), GROUP)
    if not any(sheet[name].piece for name in rows["specimen"].unique()):
        return rows
    pieces = rows["specimen"].map(lambda name: sheet[name].tested_piece).rename("of_piece")
    keys = [rows[name] for name in GROUP] + [pieces]
    parts = [
        _one_row(str(key[-1]), part) for key, part in rows.groupby(keys, dropna=False, sort=False)
    ]
    return pd.concat(parts, ignore_index=True)


def _recorded(rows: pd.DataFrame) -> pd.DataFrame:
    """Empty the values that are the largest of a record that shows no failure."""
    open_ = rows["value"].notna() & rows["flags"].str.contains(UNRECORDED, regex=False)
    if not open_.any():
        return rows
    flags = NOT_ASSESSED + rows.loc[open_, "flags"]
    return rows.assign(value=rows["value"].mask(open_), flags=rows["flags"].mask(open_, flags))


def of_sensors(rows: pd.DataFrame, group: Sequence[str]) -> pd.DataFrame:
    """Empty what crosshead travel gives in groups in which another specimen has a sensor.

    Travel includes the compliance of machine and grips, so a modulus from it can be a third of
    the material's. Where no specimen of a group has a sensor, all of its values stay, flagged.

    Parameters
    ----------
    rows : DataFrame
        Columns of `nptcs.tables.laboratory.properties.PropertiesTable`.
    group : sequence of str
        Columns whose equal values make a group: a mean over several tests has a wider one.
    """
    of_strain = rows["value"].notna() & ~rows["property"].isin(WITHOUT_STRAIN)
    travel = of_strain & rows["flags"].str.contains(CROSSHEAD, regex=False)
    if not travel.any():
        return rows
    sensor = of_strain & ~travel
    mixed = travel & sensor.groupby([rows[key] for key in group], dropna=False).transform("any")
    flags = TRAVEL_NEXT_TO_SENSORS + "; " + rows.loc[mixed, "flags"]
    return rows.assign(value=rows["value"].mask(mixed), flags=rows["flags"].mask(mixed, flags))


def _one_row(piece: str, runs: pd.DataFrame) -> pd.DataFrame:
    assessed = runs[runs["value"].notna()]
    row = (assessed if len(assessed) else runs).iloc[:1].copy()
    row["specimen"] = piece
    if len(assessed) > 1:
        row["value"] = assessed["value"].mean()
        row["standard_error"] = np.nan
        row["points"] = assessed["points"].sum()
        names = ", ".join(assessed["specimen"])
        flags = "; ".join(dict.fromkeys(flag for flag in assessed["flags"] if flag))
        row["flags"] = "; ".join(text for text in (f"mean of the runs {names}", flags) if text)
    return row


def why_not(flags: str) -> str:
    """Reason why a value was not assessed, from its flags."""
    reasons = [f for f in flags.split("; ") if f.startswith(NOT_ASSESSED)]
    return reasons[0].removeprefix(NOT_ASSESSED) if reasons else "no value"


def left_out(properties: pd.DataFrame, sheet: Mapping[str, Specimen]) -> str:
    """Rows of one group that do not count, each with its reason."""
    words = []
    for name, prop in zip(properties["specimen"], properties["property"], strict=True):
        specimen = sheet[name]
        if not specimen.include:
            words.append(f"{name}: {specimen.reason}")
        elif not specimen.gives(prop):
            reason = specimen.reason or "the sheet takes other properties from this run"
            words.append(f"{name}: {reason}")
    return "; ".join(words)
