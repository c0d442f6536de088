"""Copies of a test that were changed: cut at an end, or thinned."""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from nptcs.arrays import Array
from nptcs.ingest.reading.columns.names import LOADS, STRAINS
from nptcs.ingest.reading.raw_file import RawFile

DIGITS = 6
"""Digits that are kept of the largest reading; the others are rounded to the same decimal."""
SIZE = 64
FEWEST_PAIRS = 40
LOADED = 0.05
"""Share of the largest load from which on a reading counts: idle ones are alike in all tests."""
FINE = 50
"""Distinct second differences of a load whose resolution shows its noise; with a coarser one, or
without noise, specimens with equal strains agree by chance."""
SHARED = 0.4
"""Share of the sampled pairs that two tests of different specimens never have in common."""


def data_sketch(tables: Sequence[RawFile]) -> tuple[int, ...]:
    """Sample the pairs of load and strain of a file, the same ones wherever they occur.

    Each pair, rounded, has a number that depends on nothing else; the smallest `SIZE` of them are
    the sample. The share that two samples have in common is about that of the tests (bottom-k
    sketch). Without noise nothing tells two specimens from two copies, and the sketch is empty.

    Parameters
    ----------
    tables : sequence of RawFile
        One file with load and strain; the rows of two files do not correspond, and the sketch is
        empty.
    """
    table = tables[0]
    load, strain = (
        next((table.values[name] for name in names if name in table.values), None)
        for names in (LOADS, (*STRAINS, "displacement"))
    )
    if len(tables) > 1 or load is None or strain is None:
        return ()
    rows = np.isfinite(load) & np.isfinite(strain)
    rows &= np.abs(load) > LOADED * np.nanmax(np.abs(load), initial=0.0)
    load, strain = load[rows], strain[rows]
    if len(load) < FEWEST_PAIRS or not np.abs(strain).max():
        return ()
    steps = _rounded(load)
    if not _shows_noise(steps):
        return ()
    mixed = _mixed(steps * 10 ** (DIGITS + 2) + _rounded(strain))
    if len(mixed) > 4 * SIZE:  # a pair may occur twice, but seldom four times
        mixed = np.partition(mixed, 4 * SIZE)[: 4 * SIZE]
    smallest = np.unique(mixed)
    if len(smallest) < FEWEST_PAIRS:
        return ()
    return tuple(int(number) for number in smallest[:SIZE])


def _shows_noise(steps: npt.NDArray[np.int64]) -> bool:
    """Tell whether a load has many distinct second differences; its start often suffices."""
    second, least = np.diff(steps, 2), min(FINE, len(steps) // 2)
    return any(len(np.unique(part)) >= least for part in (second[: 4 * FINE], second))


def _rounded(readings: Array) -> npt.NDArray[np.int64]:
    """Write readings as whole multiples of the last of `DIGITS` digits of the largest."""
    unit = 10.0 ** (np.floor(np.log10(np.abs(readings).max())) - DIGITS + 1)
    return np.rint(readings / unit).astype(np.int64)


def _mixed(pairs: npt.NDArray[np.int64]) -> npt.NDArray[np.int64]:
    """Spread numbers evenly over 0 … 2^53 (the finaliser of splitmix64)."""
    mixed = pairs.astype(np.uint64)
    for shift, factor in ((30, 0xBF58476D1CE4E5B9), (27, 0x94D049BB133111EB)):
        mixed = (mixed ^ (mixed >> np.uint64(shift))) * np.uint64(factor)
    return ((mixed ^ (mixed >> np.uint64(31))) >> np.uint64(11)).astype(np.int64)


class ChangedCopies:
    """Sketches seen so far, in the order of the sheet."""

    def __init__(self) -> None:
        self._seen: dict[str, frozenset[int]] = {}
        self._having: dict[int, list[str]] = defaultdict(list)

    def earlier(self, specimen: str, sketch: Sequence[int]) -> str:
        """Add a sketch and return the first specimen that it is a copy of; empty if none."""
        mine = frozenset(sketch)
        common = Counter(name for number in mine for name in self._having[number])
        copied = [
            name
            for name in self._seen
            if common[name] and _shared(mine, self._seen[name]) >= SHARED
        ]
        self._seen[specimen] = mine
        for number in mine:
            self._having[number].append(specimen)
        return copied[0] if copied else ""


def _shared(one: frozenset[int], other: frozenset[int]) -> float:
    """Share of the smallest numbers of both that both have."""
    smallest = sorted(one | other)[:SIZE]
    return sum(number in one and number in other for number in smallest) / len(smallest)
