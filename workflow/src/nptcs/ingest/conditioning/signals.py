"""Readings of one test on common rows, between raw files and the tidy curve."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from nptcs.arrays import Array, Mask, Rows
from nptcs.tables.laboratory.curves import ConditioningStep

STRAIN_CHANNELS = (
    "strain",
    "strain_transverse",
    "strain_back",
    "strain_xx",
    "strain_yy",
    "stretch",
    "extension",
    "displacement",
    "extension_transverse",
)

LENGTHS = ("extension", "displacement", "extension_transverse")
"""Channels in mm; the others are strains."""


@dataclass
class Signals:
    """Quantity → readings (s, N, mm, MPa, dimensionless), all of one length.

    `steps` and `flags` say what was done to them; both end up in the ingest record.
    `failure_seen` tells whether a break was recorded, in these rows or in those left out.
    """

    values: dict[str, Array]
    steps: list[ConditioningStep] = field(default_factory=list)
    flags: list[str] = field(default_factory=list)
    failure_seen: bool = False

    def __len__(self) -> int:
        return len(next(iter(self.values.values())))

    def take(self, rows: Mask | Rows) -> None:
        """Keep some rows."""
        self.values = {name: readings[rows] for name, readings in self.values.items()}

    def note(self, name: str, changed: str, **numbers: float) -> None:
        """Log a step that was on."""
        self.steps.append(ConditioningStep(name=name, on=True, changed=changed, numbers=numbers))

    def skipped(self, name: str) -> None:
        """Log a step that is switched off."""
        self.steps.append(ConditioningStep(name=name, on=False, changed="switched off"))


def line_slope(x: Array, y: Array) -> float:
    """Slope of the least-squares line y(x)."""
    centred = x - x.mean()
    return float(centred @ y / (centred @ centred))


def largest(readings: Array) -> float:
    """Return the reading of largest magnitude, with its sign; NaN does not count."""
    return float(readings[np.nanargmax(np.abs(readings))])
