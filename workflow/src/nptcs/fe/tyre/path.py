"""Points of a tyre's load path: the start of the next one, and whether it is on the same branch."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from nptcs.arrays import Array

# a step may be this much softer than the last one: beyond that it is another equilibrium
LARGEST_SOFTENING = 1.4


@dataclass(frozen=True)
class LoadPoint:
    """A loaded tyre on its path: ring displacements (nodes, 2) mm, ground's rise, stresses MPa."""

    force_n: float
    displacement: Array
    rise_mm: float
    stresses: list[Array]


def extrapolated(before: LoadPoint, last: LoadPoint, force_n: float) -> LoadPoint:
    """Extrapolate two points linearly to a load."""
    part = (force_n - last.force_n) / (last.force_n - before.force_n)
    return LoadPoint(
        force_n,
        last.displacement + part * (last.displacement - before.displacement),
        last.rise_mm + part * (last.rise_mm - before.rise_mm),
        [b + part * (b - a) for a, b in zip(before.stresses, last.stresses, strict=True)],
    )


def check_branch(
    forces_n: Sequence[float], rises_mm: Sequence[float], force_n: float, rise_mm: float
) -> None:
    """Refuse a step that has jumped to another equilibrium, in which wires have buckled.

    Raises
    ------
    FloatingPointError
        If the tyre has given way much more for this step than for the last one.
    """
    load, rise = np.array(forces_n[-2:]), np.array(rises_mm[-2:])
    last = float(np.diff(rise)[0] / np.diff(load)[0])
    if rise_mm - rise[1] > LARGEST_SOFTENING * last * (force_n - load[1]):
        raise FloatingPointError("the tyre gives way suddenly, as when wires buckle")
