"""A force whose zero or range changed in the middle of a test: tared again, amplifier switched."""

from __future__ import annotations

import numpy as np

from nptcs.arrays import Array
from nptcs.ingest.conditioning.signals import Signals
from nptcs.ingest.conditioning.strains import NO_STRAIN

WINDOW, FEWEST = 30, 8
"""Readings on each side of a leap from which the slopes are taken, and the fewest allowed."""
SMALLEST = 0.1
"""Share of the force by which it must leap: less may be a tow or a ply that breaks."""
ALIKE = 0.1
"""Largest relative difference of slopes that count as equal; a specimen that broke in part is
softer by the part that broke."""
STEADY = 5.0
"""At a leap the step of the force is at least this many usual steps, that of the strain at most."""
CERTAIN = 0.03
"""Largest standard error of a slope, as a share of it."""
RANGES = (10.0, 100.0, 1000.0, 0.1, 0.01, 0.001)


def cut_rescaled(signals: Signals, source: str) -> None:
    """Cut the record where the force leaps while the strain goes on and the stiffness stays.

    A specimen that breaks in part has lost its share of the stiffness; one that slips in the grips
    gives back strain. A load cell that was tared again goes on with the same slope as before, and
    one whose range was switched with a slope and a force that are both the same power of ten times
    those before.

    Parameters
    ----------
    signals : Signals
        With ``force`` and ``strain_axial``; is cut and flagged.
    source : str
        Source of the strain; travel shows nothing, since it goes on when a specimen slips.
    """
    if source in ("crosshead", NO_STRAIN):
        return
    load, strain = np.abs(signals.values["force"]), signals.values["strain_axial"]
    found = rescaled_from(load, strain)
    if found is None:
        return
    row, factor = found
    rows = len(load) - row
    before, after = float(load[row - 1]), float(load[row])
    signals.take(np.arange(row))
    signals.failure_seen = False
    signals.note("load cell", f"leaps from {before:.5g} N: {rows} rows cut", rows=rows)
    signals.flags.append(
        f"the force leaps from {before:.5g} to {after:.5g} N while the strain goes on, and then "
        "grows as stiffly as before: the load cell was probably set to zero again; cut from there, "
        "so neither strength nor failure is known"
        if factor == 1
        else f"the force leaps from {before:.5g} to {after:.5g} N while the strain goes on, and "
        f"then grows at {factor:g} times that scale: its range was probably switched; cut from "
        "there, so neither strength nor failure is known"
    )


def rescaled_from(load: Array, strain: Array) -> tuple[int, float] | None:
    """First reading after a change of the force's zero or range, and the factor of its scale.

    Parameters
    ----------
    load : ndarray, shape (n,)
        Magnitude of the force.
    strain : ndarray, shape (n,)
        Strain of a gauge, of one sign; may contain NaN.
    """
    known = np.flatnonzero(np.isfinite(strain) & np.isfinite(load))
    if len(known) < 2 * FEWEST:
        return None
    force, course = load[known], np.abs(strain[known])
    leap = np.abs(np.diff(force)) > SMALLEST * np.maximum(force[:-1], force[1:])
    leap &= np.maximum(force[:-1], force[1:]) > SMALLEST * force.max()
    leap &= np.diff(known) == 1
    for last in np.flatnonzero(leap):
        if factor := _goes_on(force, course, int(last)):
            return int(known[last + 1]), factor
    return None


def _goes_on(force: Array, strain: Array, last: int) -> float | None:
    """Factor of the scale at which the force goes on after reading `last`; None if it does not.

    It is 1 where the zero was set again.
    """
    near = slice(max(0, last + 1 - WINDOW), last + 1 + WINDOW)
    if abs(force[last + 1] - force[last]) < STEADY * np.median(np.abs(np.diff(force[near]))):
        return None
    before = slice(max(0, last + 1 - WINDOW), last + 1)
    after = slice(last + 1, last + 1 + WINDOW)
    if min(len(force[before]), len(force[after])) < FEWEST:
        return None
    step = abs(strain[last + 1] - strain[last])
    usual = np.median(np.abs(np.diff(strain[near])))
    slopes = [_slope(strain[part], force[part]) for part in (before, after)]
    if step > STEADY * usual or None in slopes:
        return None
    (first, second), ratio = slopes, force[last + 1] / force[last]
    if first is None or second is None:
        return None
    if abs(second / first - 1) <= ALIKE:
        return 1.0
    for factor in RANGES:
        if abs(second / first / factor - 1) <= ALIKE and abs(ratio / factor - 1) <= ALIKE:
            return factor
    return None


def _slope(strain: Array, force: Array) -> float | None:
    """Least-squares slope; None where it is not positive or not certain."""
    away = strain - strain.mean()
    spread = float(away @ away)
    if not spread > 0:
        return None
    slope = float(away @ force) / spread
    rest = force - force.mean() - slope * away
    error = float(np.sqrt(rest @ rest / max(len(rest) - 2, 1) / spread))
    return slope if slope > 0 and error <= CERTAIN * slope else None
