"""Machine rows that belong to camera frames: by a trigger channel, or by the frame's number."""

from __future__ import annotations

import numpy as np

from nptcs.arrays import Rows
from nptcs.ingest.reading.raw_file import RawFile

_FEWEST = 5
_COVERED = 0.9


def rows_by_trigger(force: RawFile, strain: RawFile) -> Rows | None:
    """Machine row of each frame, by the rising edges of a trigger channel.

    Returns
    -------
    ndarray of int, shape (frames,), or None
        None if there is no trigger, or the number of its edges is not that of the frames.
    """
    trigger = force.values.get("trigger")
    if trigger is None or np.isnan(trigger).any() or not np.ptp(trigger):
        return None
    high = trigger > 0.5 * (trigger.max() + trigger.min())
    edges = np.flatnonzero(high & ~np.concatenate([[False], high[:-1]]))
    return edges if len(edges) == strain.rows >= _FEWEST else None


def rows_by_number(force: RawFile, strain: RawFile) -> tuple[Rows, Rows] | None:
    """Machine row of each frame, by a frame counter that both files contain.

    The machine's counter stands still between two frames; the row in which it first shows a
    number is the row of that frame.

    Returns
    -------
    (ndarray of int, ndarray of int) or None
        Rows of the machine and of the camera; None if the counters do not belong together.
    """
    ours, theirs = force.values.get("frame"), strain.values.get("frame")
    if ours is None or theirs is None or np.isnan(ours).any() or np.isnan(theirs).any():
        return None
    if (np.diff(ours) < 0).any() or (np.diff(theirs) <= 0).any():
        return None
    numbers, rows = np.unique(ours, return_index=True)
    shared = np.isin(theirs, numbers)
    if shared.sum() < max(_FEWEST, _COVERED * len(theirs)):
        return None
    camera = np.flatnonzero(shared)
    return rows[np.searchsorted(numbers, theirs[camera])], camera
