"""Channels that jump away for some readings and back: a loose cable, an overloaded amplifier."""

from __future__ import annotations

import numpy as np

from nptcs.arrays import Array
from nptcs.config.materials.ingest import MissingValues
from nptcs.ingest.conditioning.signals import STRAIN_CHANNELS, Signals
from nptcs.ingest.reading.raw_file import RawFile

SMALLEST_SHARE = 0.1
"""Share of the channel's range: a smaller leap is ignored, ..."""
HELD_SHARE = 0.02
"""... unless the channel then stands still to the last digit, as a lost one does at zero."""
USUAL_STEPS = 20.0
LONGEST_SHARE = 0.05
"""Largest share of the readings that an excursion may last."""
SHORTEST = 5
_BACK = 0.3
_FEWEST = 20


def empty_excursions(signals: Signals, settings: MissingValues) -> None:
    """Empty readings between a leap and the leap back, and what leaps up just before a break.

    Only where the other channel, strain for a force and force for a strain, does not leap at the
    same time: a machine that unloads and loads within one reading moves both. Without another
    channel, at most `SHORTEST` readings are emptied at a time.

    Parameters
    ----------
    signals : Signals
        Before axis and sign are judged; is changed, and gets a flag.
    settings : MissingValues
        Whether the step is on.
    """
    if not settings.enabled:
        return
    values = signals.values
    strain = next((values[name] for name in STRAIN_CHANNELS if name in values), None)
    found = {}
    for name in ("force", "stress", *STRAIN_CHANNELS):
        other = strain if name in ("force", "stress") else values.get("force")
        if name not in values:
            continue
        gone = find_excursions(values[name], other, before_break=name in ("force", "stress"))
        if gone.any():
            values[name] = np.where(gone, np.nan, values[name])
            found[name] = int(gone.sum())
    if found:
        words = ", ".join(f"{number} of {name}" for name, number in found.items())
        first = next(iter(found))
        signals.flags.append(f"readings that jump away and back were emptied: {words}")
        signals.note("excursions", f"emptied: {words}", **{f"{first}_readings": found[first]})


def empty_in_table(table: RawFile, settings: MissingValues) -> list[str]:
    """Empty the excursions of one of two files, before they are paired.

    Returns
    -------
    list of str
        A flag where something was emptied.
    """
    signals = Signals(dict(table.values))
    empty_excursions(signals, settings)
    table.values = signals.values
    return [f"{table.path.name}: {flag}" for flag in signals.flags]


def find_excursions(readings: Array, other: Array | None, before_break: bool) -> np.ndarray:
    """Mark the readings of a channel that belong to an excursion.

    Parameters
    ----------
    readings, other : ndarray, shape (n,)
        The channel, and the one that must not leap at the same time.
    before_break : bool
        Whether a leap up that ends below where it began counts as well.

    Returns
    -------
    ndarray of bool, shape (n,)
    """
    gone = np.zeros(len(readings), dtype=bool)
    kept = np.flatnonzero(~np.isnan(readings))
    if len(kept) < _FEWEST:
        return gone
    values = readings[kept]
    step = np.diff(values)
    size_of = np.abs(step)
    usual = float(np.median(size_of))
    if not size_of.max() > USUAL_STEPS * usual:
        return gone
    low, high = np.percentile(values, [1, 99])
    span = float(high - low)
    share = HELD_SHARE if usual > 0 else SMALLEST_SHARE
    leaps = np.flatnonzero(size_of > max(share * span, USUAL_STEPS * usual))
    sign = np.sign(step)  # steps of 1e200 have no product
    longest = max(SHORTEST, int(LONGEST_SHARE * len(values)))
    longest = longest if other is not None else SHORTEST
    for first in leaps:
        if gone[kept[first]] or _along(other, kept[first], kept[first + 1], step[first], span):
            continue
        size = abs(float(step[first]))
        for back in leaps[(leaps > first) & (leaps <= first + longest)]:
            apart = abs(float(values[back + 1] - values[first]))
            returned = apart <= _BACK * size + 3 * usual * (back - first)
            up = sign[first] * values[first] > 0 and abs(values[back + 1]) < abs(values[first])
            broke = before_break and up and back - first <= SHORTEST
            held = back > first + 1 and np.ptp(values[first + 1 : back + 1]) == 0
            if not held and min(size, abs(float(step[back]))) <= SMALLEST_SHARE * span:
                continue
            if sign[back] * sign[first] < 0 and (returned or broke):
                gone[kept[first + 1 : back + 1]] = True
                break
    return gone


def _along(other: Array | None, row: int, later: int, step: float, span: float) -> bool:
    """Tell whether the other channel leaps at the same time; False without one."""
    if other is None or np.isnan(other[[row, later]]).any():
        return False
    finite = other[~np.isnan(other)]
    low, high = np.percentile(finite, [1, 99])
    moved = abs(float(other[later] - other[row]))
    return bool(moved * (span or 1.0) > 0.5 * abs(step) * (high - low))
