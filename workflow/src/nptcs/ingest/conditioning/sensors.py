"""Sensors that stop measuring their specimen: taken off, slipped, moved back, stuck."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from nptcs.arrays import Array, Rows
from nptcs.config.materials.ingest import ExtensometerRemoval
from nptcs.ingest.conditioning.signals import LENGTHS, Signals, largest
from nptcs.ingest.conditioning.steps import STRAINS
from nptcs.loading import noise_of

AXIAL_CHANNELS = ("strain", "stretch", "extension", "displacement")
_LEAST_SIGHT = 6
_LARGER = 3.0
_HELD = 0.9
"""Share of the largest force above which a test that was stopped still holds its load."""


@dataclass(frozen=True)
class Loss:
    """The first reading at which a sensor no longer measured the specimen, and how it shows."""

    row: int
    what: str


def empty_lost_channels(
    signals: Signals, settings: ExtensometerRemoval, rubber: bool, gauge_length_mm: float | None
) -> None:
    """Empty each axial channel from where its sensor came off, before axis and sign are judged.

    A sensor that rests at -3 % after it was taken off would otherwise turn the sign of the strain
    of the whole test. Lengths are judged as strains over the gauge length.
    """
    if not settings.enabled:
        return
    force = signals.values["force"]
    smallest = _smallest(settings, rubber)
    names = [name for name in AXIAL_CHANNELS if name in signals.values]
    for name in names:
        scale = 1.0 if name not in LENGTHS else 1 / (gauge_length_mm or np.inf)
        readings = signals.values[name]
        loss = find_jump(readings * scale, force, settings.jump_factor, smallest)
        if loss is not None:
            signals.values[name] = np.where(np.arange(len(force)) < loss.row, readings, np.nan)
            _say(signals, loss, name.replace("_", " "), readings)
    pair = [name for name in ("strain_xx", "strain_yy") if name in signals.values]
    found = [
        find_jump(signals.values[name], force, settings.jump_factor, smallest) for name in pair
    ]
    first = min((loss.row for loss in found if loss is not None), default=None)
    if first is not None:
        for name in pair:
            kept = np.arange(len(force)) < first
            signals.values[name] = np.where(kept, signals.values[name], np.nan)
        _say(signals, Loss(first, "jumps"), "camera's strain", signals.values[pair[0]])


def empty_after_removal(
    signals: Signals, settings: ExtensometerRemoval, rubber: bool, source: str
) -> None:
    """Empty the strains from where a sensor was taken off, slipped, moved back or stood still.

    Crosshead travel can neither be taken off nor stand still, but a transducer of travel can slip.
    """
    if not settings.enabled:
        signals.skipped("extensometer")
        return
    sign = np.sign(largest(signals.values["force"]))
    strain, force = sign * signals.values["strain_axial"], sign * signals.values["force"]
    smallest = _smallest(settings, rubber)
    losses = [
        find_jump(strain, force, settings.jump_factor, smallest),
        find_reversal(strain, force, settings.largest_return, smallest),
    ]
    if source != "crosshead":
        end = min((loss.row for loss in losses if loss is not None), default=None)
        losses.append(find_stuck(strain[:end], force[:end], settings.stuck_force_share))
    first = min(
        (loss for loss in losses if loss is not None), key=lambda loss: loss.row, default=None
    )
    if first is None:
        signals.note("extensometer", "no removal or slip found")
        return
    for name in STRAINS:
        kept = np.arange(len(strain)) < first.row
        signals.values[name] = np.where(kept, signals.values[name], np.nan)
    _say(signals, first, "strain", signals.values["strain_axial"])


def _smallest(settings: ExtensometerRemoval, rubber: bool) -> float:
    return settings.smallest_jump_rubber if rubber else settings.smallest_jump


def _say(signals: Signals, loss: Loss, channel: str, readings: Array) -> None:
    """Note and flag a loss, with the last reading before it; frames between may be empty."""
    before = readings[: loss.row]
    at = float(before[~np.isnan(before)][-1])
    signals.note(
        "extensometer",
        f"{channel} {loss.what} at reading {loss.row + 1}: emptied from there",
        last_strain=at,
        rows=len(signals) - loss.row,
    )
    sensor = (
        "transducer of travel slipped"
        if channel == "displacement"
        else "extensometer removed or slipped"
    )
    signals.flags.append(f"{sensor}: {channel} {loss.what} at {at:.4g}, emptied from there")


def find_jump(strain: Array, force: Array, jump_factor: float, smallest: float) -> Loss | None:
    """First reading whose strain leaps while the force neither falls nor leaps.

    Parameters
    ----------
    strain, force : ndarray, shape (n,)
        Of any sign; examined up to the largest force, and beyond it while that force is held.
    jump_factor : float
        A leap is this many times the usual step.
    smallest : float
        Smallest leap, as a strain.
    """
    load = np.abs(force)
    peak = int(np.nanargmax(load))
    fallen = np.flatnonzero(load[peak:] < _HELD * load[peak])
    end = peak + int(fallen[0]) if len(fallen) else len(load)
    rows = np.flatnonzero(~np.isnan(strain[:end]) & ~np.isnan(load[:end]))
    if len(rows) < _LEAST_SIGHT:
        return None
    step, gain = np.diff(strain[rows]), np.diff(load[rows])
    if not np.abs(step).max() > smallest:
        return None
    moving = np.abs(step[step != 0])
    usual = float(np.median(moving)) if len(moving) else 0.0
    usual_gain = float(np.median(np.abs(gain)))
    size = np.abs(step)
    # travel through slack is fast for a long time: a leap is larger than the step just before it
    before = np.concatenate([[np.inf], size[:-1]])
    leaps = (size > max(jump_factor * usual, smallest)) & (size > _LARGER * before)
    leaps &= (gain > -0.05 * load[peak]) & (np.abs(gain) < 0.25 * jump_factor * usual_gain)
    return Loss(int(rows[int(np.argmax(leaps)) + 1]), "jumps") if leaps.any() else None


def find_reversal(strain: Array, force: Array, share: float, smallest: float) -> Loss | None:
    """First reading from which the strain goes back although the force is higher than ever.

    Only readings at which the force exceeds all before count, so that unloading and reloading
    are not a reversal. The strain must lose `share` of what was reached, and `smallest`.
    """
    peak = int(np.nanargmax(force))
    rows = np.flatnonzero(~np.isnan(strain[: peak + 1]) & ~np.isnan(force[: peak + 1]))
    if len(rows) < _LEAST_SIGHT:
        return None
    higher = force[rows] > np.concatenate([[-np.inf], np.maximum.accumulate(force[rows])[:-1]])
    rows = rows[higher]
    if len(rows) < _LEAST_SIGHT:
        return None
    reached = np.maximum.accumulate(strain[rows])
    lost = reached - strain[rows]
    limit = np.maximum(share * (reached - strain[rows][0]), smallest)
    back = np.flatnonzero(lost > limit)
    if not len(back):
        return None
    turn = int(np.argmax(strain[rows][: int(back[0])]))
    return Loss(int(rows[turn]) + 1, "moves back")


def find_stuck(strain: Array, force: Array, share: float) -> Loss | None:
    """First reading from which the force climbs by `share` of its peak and more, without strain.

    Only a standstill that lasts to the end of the climb counts: a start that lags is a toe, and a
    leap is found by `find_jump`.
    """
    if not len(force):
        return None
    rising = np.maximum.accumulate(force)
    levels = np.arange(share, 1.0, share) * rising[-1]
    rows = np.unique(np.searchsorted(rising, levels))
    rows = rows[~np.isnan(strain[rows])]
    if len(rows) < _LEAST_SIGHT:
        return None
    gains = np.diff(strain[rows])
    usual = float(np.median(gains[gains > 0])) if (gains > 0).any() else 0.0
    # two readings differ by noise alone, so a difference below the noise is a standstill, too
    noise = 4 * 2**0.5 * noise_of(strain[~np.isnan(strain)])
    least = max(0.02 * usual, min(noise, 0.25 * usual), np.finfo(float).tiny)
    moving = np.flatnonzero(gains >= least)
    last = int(moving[-1]) + 1 if len(moving) else 0
    if last >= len(gains):
        return None
    return Loss(_stands_from(strain, rows, last) + 1, "stands still")


def _stands_from(strain: Array, rows: Rows, last: int) -> int:
    """First reading at the level at which the strain then stays, at most one step earlier.

    The steps are coarse; a reading of the climb without strain would count at too high a force.
    """
    standing = strain[rows[last] + 1 : rows[last + 1] + 1]
    standing = standing[~np.isnan(standing)]
    if not len(standing):
        return int(rows[last])
    level = float(np.median(standing)) - 3 * float(np.std(standing))
    before = slice(rows[max(last - 1, 0)], rows[last] + 1)
    reached = np.flatnonzero(strain[before] >= level)
    return int(rows[max(last - 1, 0)] + reached[0]) if len(reached) else int(rows[last])
