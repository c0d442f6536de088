"""A load cell at the end of its range: the force stands still while the specimen is stretched."""

from __future__ import annotations

import numpy as np

from nptcs.arrays import Array, Mask
from nptcs.ingest.conditioning.signals import Signals

FEWEST_READINGS = 5
"""Readings that equal the largest force: fewer happen by rounding."""
LAST_DIGIT = 2e-4
"""Share of the largest force by which such readings may differ: the last digit of a converter."""
LONGER = 4
"""The standstill must be this many times longer than any other of the force on its way up."""
STRETCHED = 0.05
"""Share of the whole elongation that the specimen must gain meanwhile."""
FULL_RATE = 0.5
"""Share of the usual rate at which the force must still grow before it stands still; a force that
goes over a maximum slows down first."""


def cut_saturated(signals: Signals) -> None:
    """Cut the record where the load cell, or its channel, reached the end of its range.

    What is read from there on is not the force, so neither strength nor failure is known; the
    readings before it are kept.

    Parameters
    ----------
    signals : Signals
        With ``force``, and an elongation that tells whether the specimen was stretched meanwhile.
    """
    load = np.abs(signals.values["force"])
    elongation = signals.values["strain_axial"]
    if not np.isfinite(elongation).any():
        elongation = signals.values.get("displacement", elongation)
    first = saturated_from(load, elongation)
    if first is None:
        return
    rows = len(load) - first - 1
    highest = float(load[first])
    signals.take(np.arange(first + 1))
    signals.failure_seen = False
    signals.note("load cell", f"stands still at {highest:.5g} N: {rows} rows cut", rows=rows)
    signals.flags.append(
        f"load cell saturated: the force stands still at {highest:.5g} N while the specimen is "
        "stretched; cut from there, so neither strength nor failure is known"
    )


def saturated_from(load: Array, elongation: Array) -> int | None:
    """First reading of a standstill of the load at its largest value; None if there is none.

    Parameters
    ----------
    load : ndarray, shape (n,)
        Magnitude of the force; finite.
    elongation : ndarray, shape (n,)
        Strain or travel in any unit and sign; may contain NaN.
    """
    highest = float(load.max())
    at_limit = load >= highest * (1 - LAST_DIGIT)
    first, length = _longest(at_limit)
    start = int(np.argmax(load >= 0.2 * highest))
    usual = (highest - load[start]) / max(first - start, 1)
    by_chance = max(
        _longest_below(load[: first + 1], highest), LAST_DIGIT * highest / max(usual, 1e-300)
    )
    if length < max(FEWEST_READINGS, LONGER * by_chance):
        return None
    known = np.flatnonzero(np.isfinite(elongation))
    if not len(known):
        return None
    ends = np.interp([first, first + length - 1], known, elongation[known])
    if abs(ends[1] - ends[0]) < STRETCHED * float(np.ptp(elongation[known])):
        return None
    before = max(first - length, (start + first) // 2)
    if first - before < 1:
        return None
    last = (highest - load[before]) / (first - before)
    return first if last >= FULL_RATE * usual else None


def _longest(marked: Mask) -> tuple[int, int]:
    """Start and length of the longest run of marked readings."""
    edges = np.flatnonzero(np.diff(np.concatenate([[0], marked.astype(int), [0]])))
    lengths = edges[1::2] - edges[::2]
    longest = int(np.argmax(lengths))
    return int(edges[::2][longest]), int(lengths[longest])


def _longest_below(load: Array, highest: float) -> int:
    """Length of the longest standstill on the way up, between 20 and 98 % of the largest load."""
    rising = load[(load > 0.2 * highest) & (load < 0.98 * highest)]
    still = np.diff(rising) == 0
    return _longest(still)[1] + 1 if still.any() else 1
