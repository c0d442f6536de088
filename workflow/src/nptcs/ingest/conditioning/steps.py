"""Signal conditioning: each step logged, each step can be switched off."""

from __future__ import annotations

import numpy as np

from nptcs.arrays import Array, Rows
from nptcs.config.materials.ingest import EndOfTest, ForceZero, MissingValues
from nptcs.ingest.conditioning.failure import failure_row
from nptcs.ingest.conditioning.signals import STRAIN_CHANNELS, Signals

STRAINS = ("strain_axial", "strain_transverse", "strain_axial_back")


def mark_dead(signals: Signals, settings: MissingValues) -> None:
    """Empty the logger's dead values and remove strain channels that are dead throughout."""
    if not settings.enabled:
        signals.skipped("dead channels")
        return
    dead, emptied = [], 0
    for name, readings in signals.values.items():
        bad = np.zeros(len(readings), dtype=bool)
        for value in settings.dead_values:
            bad |= readings == value
        if bad.any():
            signals.values[name] = np.where(bad, np.nan, readings)
            emptied += int(bad.sum())
    for name in STRAIN_CHANNELS:
        if name in signals.values and _is_dead(signals.values[name], settings.largest_share):
            del signals.values[name]
            dead.append(name)
    what = f"removed {', '.join(dead)}; " if dead else ""
    signals.note("dead channels", f"{what}{emptied} readings emptied", emptied=emptied)


def _is_dead(readings: Array, largest_share: float) -> bool:
    """Tell whether a channel is constant, or lacks readings between its first and its last."""
    measured = np.flatnonzero(~np.isnan(readings))
    if not len(measured):
        return True
    span = readings[measured[0] : measured[-1] + 1]
    return bool(np.isnan(span).mean() > largest_share or np.ptp(readings[measured]) == 0)


def empty_spikes(signals: Signals, settings: MissingValues) -> None:
    """Empty single readings far from both neighbours, such as those with a lost bit or digit.

    A reading counts if it is off both neighbours, to the same side, by more than ``spike_share``
    of the channel's range (1st to 99th percentile) and 20 usual steps; at a failure it is off
    only one of them.
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
            if len(rows):
                signals.values[name] = signals.values[name].copy()
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
    size = np.abs(step)
    leaves = np.minimum(size[:-1], size[1:])
    leaves[np.sign(step[:-1]) * np.sign(step[1:]) >= 0] = 0.0
    if 2 * np.count_nonzero(size >= leaves.max() / 20) > len(size):
        return kept[:0]  # then the median step is at least that, too
    usual = 20 * float(np.median(size))
    low, high = np.percentile(values, [1, 99])
    return kept[1:-1][leaves > max(share * float(high - low), usual)]


def drop_empty_rows(signals: Signals, settings: MissingValues) -> None:
    """Drop rows without force, and frames without strain between frames with one.

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
    """Cut what follows failure; an unloading is not a failure and stays."""
    if not settings.enabled:
        signals.skipped("end of test")
        return
    force = signals.values["force"]
    elongation = signals.values.get("displacement", signals.values["strain_axial"])
    end = failure_row(force, elongation, settings.force_drop, signals.values.get("time"))
    peak = float(np.abs(force[:end]).max())
    if end is None:
        text = "no failure recorded, nothing cut"
        if signals.failure_seen:
            text = "failure is in the force file; nothing of it is in these rows"
        signals.note("end of test", text, rows=0, peak_force_n=peak)
        return
    dropped = len(force) - end
    signals.failure_seen = True
    signals.take(np.arange(end))
    signals.note(
        "end of test", f"{dropped} rows after failure cut", rows=dropped, peak_force_n=peak
    )
