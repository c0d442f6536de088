"""Sums of element tangents into the places of a matrix, compiled by numba."""

from __future__ import annotations

from nptcs.arrays import Array, Places
from nptcs.machine_code import compiled


@compiled
def add_at(targets: Places, keep: Places, tangents: Array, whole: Array) -> None:
    """Add the kept entries of element tangents, flattened, to their targets."""
    for place in range(len(keep)):
        whole[targets[place]] += tangents[keep[place]]
