"""Rows of the property table, and what all reductions share."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace

import pandas as pd

from nptcs.arrays import Array
from nptcs.reduce.curve.chord import Chord
from nptcs.tables.laboratory.specimens import Specimen

NAN = float("nan")
# properties of the test, not of the material: no B-basis value is made of them
TEST_CONDITIONS = (
    "strain_rate",
    "time_to_failure",
    "bending_percent",
    "bending_at_failure_percent",
)


@dataclass(frozen=True)
class Property:
    """One property of one specimen, before it becomes a row."""

    name: str
    value: float
    unit: str
    rule: str
    range: str = ""
    points: int = 0
    flags: tuple[str, ...] = ()
    r_squared: float = NAN
    standard_error: float = NAN
    range_low: float = NAN
    range_high: float = NAN
    origin_effect_percent: float = NAN

    def flagged(self, flags: Iterable[str]) -> Property:
        """Return the property with further flags."""
        return replace(self, flags=(*self.flags, *flags))


def missing(name: str, unit: str, rule: str, reason: str) -> Property:
    """Return a property without a value that says why."""
    return Property(name, NAN, unit, rule, flags=(f"not assessed: {reason}",))


def from_chord(name: str, chord: Chord, unit: str, rule: str, nominal: str) -> Property:
    """Return the property that a chord gives."""
    return Property(
        name,
        chord.slope,
        unit,
        rule,
        nominal,
        chord.points,
        chord.flags,
        chord.r_squared,
        chord.standard_error,
        chord.x_low,
        chord.x_high,
    )


def to_table(properties: Iterable[Property], specimen: Specimen) -> pd.DataFrame:
    """Return the property table of one specimen, in the columns of `PropertiesTable`.

    It is checked where it crosses a file boundary (`nptcs.tables.io.write_table`),
    not for each specimen: the check costs more than the reduction.
    """
    angle = specimen.orientation_deg
    rows = [
        {
            "specimen": specimen.specimen,
            "test": specimen.test.value,
            "material": specimen.material,
            "property": p.name,
            "value": p.value,
            "unit": p.unit,
            "rule": p.rule,
            "range": p.range,
            "points": p.points,
            "flags": "; ".join(p.flags),
            "orientation_deg": NAN if angle is None else angle,
            "r_squared": p.r_squared,
            "standard_error": p.standard_error,
            "origin": specimen.origin,
            "range_low": p.range_low,
            "range_high": p.range_high,
            "origin_effect_percent": p.origin_effect_percent,
        }
        for p in properties
    ]
    return pd.DataFrame(rows)


def finite_pair(branch: pd.DataFrame, x: str, y: str) -> tuple[Array, Array]:
    """Two columns as arrays, rows with a NaN in either left out."""
    pair = branch[[x, y]].dropna().to_numpy(dtype=float)
    return pair[:, 0], pair[:, 1]


def value_at_peak(branch: pd.DataFrame, column: str) -> float:
    """Value of a column at the largest force; NaN if it was not recorded there."""
    return float(branch[column].iloc[-1])


def chord_rule(title: str, method: str) -> str:
    """Words for a chord in the column ``rule``."""
    return f"{title} chord, {method}"


def strain_range(low: float, high: float) -> str:
    """Words for a nominal range in the column ``range``."""
    return f"strain {low:g} to {high:g}"
