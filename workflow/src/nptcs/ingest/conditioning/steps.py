"""Signal conditioning: each step logged, each step can be switched off."""

from __future__ import annotations

import numpy as np

from nptcs.arrays import Array, Rows
from nptcs.config.ingest import EndOfTest, ExtensometerRemoval, ForceZero, MissingValues
from nptcs.ingest.conditioning.signals import STRAIN_CHANNELS, Signals, largest

STRAINS = ("strain_axial", "strain_transverse", "strain_axial_back")


def mark_dead(signals: Signals, settings: MissingValues) -> None:
    """Empty the logger's dead values and remove strain channels that are dead throughout."""
    if not settings.enabled:
        signals.skipped("dead channels")
        return
    dead, emptied = [], 0
    for name, readings in signals.values.items():
        bad = np.isin(readings, settings.dead_values)
        signals.values[name] = np.where(bad, np.nan, readings)
        emptied += int(bad.sum())
    for name in STRAIN_CHANNELS:
        if name in signals.values and _is_dead(signals.values[name], settings.largest_share):
            del signals.values[name]
            dead.append(name)
    what = f"removed {', '.join(dead)}; " if dead else ""
    signals.note("dead channels", f"{what}{emptied} readings emptied", emptied=emptied)


def _is_dead(readings: Array, largest_share: float) -> bool:
    empty = np.isnan(readings)
    return bool(empty.mean() > largest_share or np.ptp(readings[~empty]) == 0)


def empty_spikes(signals: Signals, settings: MissingValues) -> None:
    """Empty single readings far from both neighbours: a bit lost, a digit lost.

    A reading counts if it leaves both neighbours, to one side, by more than ``spike_share`` of
    the channel's range (1st to 99th percentile) and 20 usual steps; failure leaves but one.
    """
    if not settings.enabled:
        signals.skipped("spikes")
        return
    found = {}
    for name in ("force", "stress", *STRAIN_CHANNELS):
        if name in signals.values:
            rows = _spikes(signals.values[name], settings.spike_share)
            for row in rows:
                found[f"{name}_reading_{row + 1}"] = float(signals.values[name][row])
            signals.values[name][rows] = np.nan
    signals.note("spikes", f"{len(found)} readings emptied", **found)
    if found:
        signals.flags.append(f"{len(found)} wild readings emptied: {', '.join(list(found)[:3])}")


def _spikes(readings: Array, share: float) -> Rows:
    kept = np.flatnonzero(~np.isnan(readings))
    if len(kept) < 10:
        return kept[:0]
    values = readings[kept]
    step = np.diff(values)
    low, high = np.percentile(values, [1, 99])
    limit = max(share * float(high - low), 20 * float(np.median(np.abs(step))))
    leaves = np.minimum(np.abs(step[:-1]), np.abs(step[1:])) > limit
    return kept[1:-1][leaves & (np.sign(step[:-1]) != np.sign(step[1:]))]


def drop_empty_rows(signals: Signals, settings: MissingValues) -> None:
    """Drop rows without force, and frames without strain that lie between frames with one.

    Rows after the last strain stay, and the row of the largest force: they carry the strength.
    """
    if not settings.enabled:
        signals.skipped("empty rows")
        return
    force, strain = signals.values["force"], signals.values["strain_axial"]
    valid = np.flatnonzero(~np.isnan(strain))
    keep = ~np.isnan(force)
    inner = np.isnan(strain) & (np.arange(len(strain)) < (valid[-1] if len(valid) else 0))
    if keep.any():
        inner[int(np.nanargmax(np.abs(force)))] = False
    frames = int((keep & inner).sum())
    without_force = int((~keep).sum())
    total = len(signals)
    signals.take(keep & ~inner)
    signals.note(
        "empty rows",
        f"{without_force} rows without force, {frames} frames without strain dropped",
        rows_without_force=without_force,
        frames_without_strain=frames,
    )
    if frames > 0.2 * total:
        signals.flags.append(f"{frames} of {total} frames have no strain")


def zero_force(signals: Signals, settings: ForceZero) -> None:
    """Subtract the force before loading, for a load cell that was not tared."""
    if not settings.enabled:
        signals.skipped("force zero")
        return
    start = float(np.mean(signals.values["force"][: settings.readings]))
    signals.values["force"] = signals.values["force"] - start
    signals.note("force zero", f"{start:.4g} N subtracted", force_n=start)


def cut_end(signals: Signals, settings: EndOfTest) -> None:
    """Cut what follows failure: the first reading after the peak that has lost the share."""
    if not settings.enabled:
        signals.skipped("end of test")
        return
    force = np.abs(signals.values["force"])
    peak = int(np.argmax(force))
    fallen = np.flatnonzero(force[peak:] < (1 - settings.force_drop) * force[peak])
    end = peak + int(fallen[0]) if len(fallen) else len(force)
    dropped = len(force) - end
    signals.take(np.arange(end))
    text = f"{dropped} rows after failure cut" if dropped else "no failure recorded, nothing cut"
    signals.note("end of test", text, rows=dropped, peak_force_n=float(force[peak]))


def empty_after_removal(
    signals: Signals, settings: ExtensometerRemoval, rubber: bool, source: str
) -> None:
    """Empty the strains from where an extensometer was taken off, slipped or stood still."""
    if not settings.enabled:
        signals.skipped("extensometer")
        return
    if source == "crosshead":
        signals.note("extensometer", "strain from the crosshead, nothing to take off")
        return
    sign = np.sign(largest(signals.values["force"]))
    strain = sign * signals.values["strain_axial"]
    force = sign * signals.values["force"]
    smallest = settings.smallest_jump_rubber if rubber else settings.smallest_jump
    jump = _first_jump(strain, force, settings.jump_factor, smallest)
    stuck = _first_stuck(strain[:jump], force[:jump], settings.stuck_force_share)
    first = min((row for row in (jump, stuck) if row is not None), default=None)
    if first is None:
        signals.note("extensometer", "no removal or slip found")
        return
    what = "jumps" if first == jump else "stands still"
    at = float(signals.values["strain_axial"][first - 1])
    for name in STRAINS:
        signals.values[name] = np.where(
            np.arange(len(strain)) < first, signals.values[name], np.nan
        )
    signals.note(
        "extensometer",
        f"strain {what} at reading {first + 1}: emptied from there",
        last_strain=at,
        rows=len(strain) - first,
    )
    signals.flags.append(f"extensometer removed or slipped at strain {at:.4g}: emptied from there")


def _first_jump(strain: Array, force: Array, jump_factor: float, smallest: float) -> int | None:
    """First reading whose strain leaps while the force does neither fall nor leap."""
    peak = int(np.argmax(force))
    step, load = np.diff(strain[: peak + 1]), np.diff(force[: peak + 1])
    usual = float(np.nanmedian(np.abs(step))) if np.isfinite(step).any() else np.nan
    usual_load = float(np.median(np.abs(load))) if len(load) else 0.0
    leaps = np.abs(step) > max(jump_factor * usual, smallest)
    leaps &= (load > -0.05 * force[peak]) & (np.abs(load) < 0.25 * jump_factor * usual_load)
    return int(np.argmax(leaps)) + 1 if leaps.any() else None


def _first_stuck(strain: Array, force: Array, share: float) -> int | None:
    """First reading from which the force climbs by `share` of its peak and more, without strain.

    Standing still counts to the end of the climb only: a start that lags is a toe, and a leap
    is found by `_first_jump`.
    """
    rising = np.maximum.accumulate(force)
    levels = np.arange(share, 1.0, share) * rising[-1]
    rows = np.unique(np.searchsorted(rising, levels))
    rows = rows[~np.isnan(strain[rows])]
    if len(rows) < 6:
        return None
    gains = np.diff(strain[rows])
    moving = np.flatnonzero(gains >= 0.02 * np.median(gains))
    last = int(moving[-1]) + 1 if len(moving) else 0
    return int(rows[last]) + 1 if last < len(gains) else None
