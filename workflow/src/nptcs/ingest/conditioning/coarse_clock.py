"""A clock that is coarser than the readings: several of them at one time."""

from __future__ import annotations

import numpy as np

from nptcs.ingest.reading.raw_file import RawFile

FEWEST_TICKS = 5


def spread_coarse_clock(table: RawFile) -> None:
    """Spread readings that share a time evenly up to the next time, and note it.

    Only where most times are shared and no time goes back: a single repeated time is a fault of
    the file, not a coarse clock. The last tick has no next one and takes the usual length.

    Parameters
    ----------
    table : RawFile
        With ``time``; is changed.
    """
    time = table.values["time"]
    if np.isnan(time).any() or (np.diff(time) < 0).any():
        return
    ticks, first, counts = np.unique(time, return_index=True, return_counts=True)
    if len(ticks) < FEWEST_TICKS or np.median(counts) < 2:
        return
    length = np.diff(ticks)
    each = np.append(length, np.median(length)) / counts
    # a record starts within a tick: its readings are the last of that tick
    each[0], each[-1] = np.median(each), np.median(each)
    places = np.arange(len(time)) - np.repeat(first, counts)
    spread = time + places * np.repeat(each, counts)
    late = counts[0] * each[0]
    spread[: counts[0]] += max(float(length[0]) - late, 0.0)
    if not (np.diff(spread) > 0).all():
        return
    table.values["time"] = spread
    table.notes = (
        *table.notes,
        f"the clock ticks every {np.median(length):.3g} s: readings spread evenly within a tick",
    )
