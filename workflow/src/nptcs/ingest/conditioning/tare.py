"""A load cell that does not read zero where no specimen carries a load."""

from __future__ import annotations

import numpy as np

from nptcs.arrays import Array
from nptcs.ingest.conditioning.signals import Signals

SMALLEST_SHARE = 0.01
"""Share of the largest force below which a remaining force is friction or noise."""
FEWEST = 3
_BROKEN = 0.25


def flag_tare(signals: Signals) -> None:
    """Flag a force that is the same before loading and after the break, and not zero.

    A preload is a true force and ends with the break; what stays is an offset of the load cell,
    or the weight of a grip, and every stress is wrong by it. Where the record shows no break,
    nothing tells the two apart, and nothing is flagged.

    Parameters
    ----------
    signals : Signals
        With ``force``, positive or negative; gets a flag.
    """
    force = signals.values["force"]
    before, after = float(np.median(force[:FEWEST])), _after_break(force)
    if after is None:
        return
    top = float(np.abs(force).max())
    if abs(after) > SMALLEST_SHARE * top and abs(before - after) < 0.3 * abs(after):
        signals.flags.append(
            f"the load cell reads {before:.4g} N before loading and {after:.4g} N after the "
            "break: it was probably not tared; ingest: force_zero subtracts it"
        )


def _after_break(force: Array) -> float | None:
    """Force that stays after a break; None where there is no break or the force does not settle."""
    peak = int(np.argmax(np.abs(force)))
    rest = force[peak + 1 :]
    low = np.flatnonzero(np.abs(rest) < _BROKEN * abs(force[peak]))
    if not len(low) or low[0] > max(FEWEST, 0.01 * peak):
        return None
    rest = rest[low[0] :]
    settled = rest[len(rest) // 2 :]
    if len(settled) < FEWEST or np.ptp(settled) > SMALLEST_SHARE * abs(force[peak]):
        return None
    return float(np.median(settled))
