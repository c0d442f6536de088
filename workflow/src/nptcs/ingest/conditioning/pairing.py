"""Force and strain from two files on common rows: by time, or by a force that both recorded."""

from __future__ import annotations

import numpy as np

from nptcs.arrays import Array, Rows
from nptcs.config.materials.ingest import EndOfTest, Pairing
from nptcs.errors import InputError
from nptcs.ingest.conditioning.coarse_clock import spread_coarse_clock
from nptcs.ingest.conditioning.common_force import (
    ends_before_peak,
    offset_by_force,
    require_equal_force,
    scale_raw_force,
    settle_force_unit,
)
from nptcs.ingest.conditioning.failure import failure_row
from nptcs.ingest.conditioning.frames import rows_by_number, rows_by_trigger
from nptcs.ingest.conditioning.signals import STRAIN_CHANNELS, Signals, largest
from nptcs.ingest.reading.raw_file import RawFile
from nptcs.ingest.reading.units import VOLTS

FEWEST_COMMON_ROWS = 5
_FRAMES_EXTENDED = 4
"""Frames whose line is extended to the largest force, by at most one frame."""


def pair(
    force: RawFile,
    strain: RawFile,
    offset_s: float | None,
    settings: Pairing,
    specimen: str,
    force_drop: float = EndOfTest().force_drop,
) -> Signals:
    """Bring the readings of two files to common rows.

    The rows are those of the slower file, so that no reading is counted twice; the reading of
    the largest force is added, so that no strength is lost between two camera frames. Between
    rows the faster file is interpolated linearly, but never across the failure of the specimen:
    readings after it are left out of both files. The strain at the largest force, which comes
    after the last frame, is extended from the last frames by at most one frame, and flagged.

    Parameters
    ----------
    force, strain : RawFile
        The two files.
    offset_s : float or None
        Added to the strain file's time. None: from the force that both recorded; otherwise 0, and
        the onsets of loading are compared.
    settings : Pairing
        Tolerances.
    specimen : str
        For messages.
    force_drop : float
        Fall of the force that counts as failure (``end_of_test.force_drop``).

    Raises
    ------
    InputError
        If nothing links the files, or the link contradicts itself.
    """
    shared = "force" in force.values and "force" in strain.values
    if shared and strain.units["force"] in VOLTS:
        scale_raw_force(force, strain, specimen)
    if shared and not strain.units["force"]:
        settle_force_unit(force, strain, settings, specimen)
    if shared:
        require_equal_force(force, strain, settings, specimen)
    timed = "time" in force.values and "time" in strain.values
    for table in (force, strain) if timed else ():
        spread_coarse_clock(table)
    edges = None if timed and shared else rows_by_trigger(force, strain)
    if edges is not None:
        how = "by the edges of the trigger channel"
        return _by_frames(force, strain, edges, np.arange(strain.rows), how, force_drop)
    numbered = None if timed else rows_by_number(force, strain)
    if numbered is not None:
        return _by_frames(force, strain, *numbered, "by the number of the frame", force_drop)
    if timed:
        return _by_time(force, strain, offset_s, shared, settings, specimen, force_drop)
    if shared:
        return _by_force(force, strain, force_drop)
    raise InputError(
        "strain and force cannot be paired: the files share neither time nor force, and no "
        "trigger or frame number that fits",
        "export the time in both, or the force as an analog channel in the strain file",
        strain.path,
        specimen=specimen,
    )


def _by_force(force: RawFile, strain: RawFile, force_drop: float) -> Signals:
    """Take the strain file's own force; add the machine's peak where the camera missed it."""
    end = _failure(strain, force_drop)
    signals = Signals({name: readings[:end] for name, readings in strain.values.items()})
    signals.failure_seen = end is not None or _failure(force, force_drop) is not None
    peak, own = largest(force.values["force"]), largest(signals.values["force"])
    if abs(peak) > abs(own):
        row = dict.fromkeys(signals.values, np.nan) | {"force": peak}
        values = signals.values
        signals.values = {name: np.append(array, row[name]) for name, array in values.items()}
        _extend_to_peak(signals, np.abs(signals.values["force"]), "N")
    signals.note(
        "pairing",
        f"by the force in {strain.path.name} (one of the files has no time); "
        f"peak force from {force.path.name}",
        rows=len(signals),
        peak_difference_percent=100 * (abs(peak) / abs(own) - 1),
    )
    return signals


def _by_frames(
    force: RawFile, strain: RawFile, rows: Rows, frames: Rows, how: str, force_drop: float
) -> Signals:
    """Take the machine's readings in the rows of the frames, and in the row of its peak."""
    end = _failure(force, force_drop)
    load = "force" if "force" in force.values else "stress"
    before = rows < (end if end is not None else force.rows)
    rows, frames = rows[before], frames[before]
    peak = int(np.nanargmax(np.abs(force.values[load][:end])))
    every = np.union1d(rows, [peak])
    kept = [name for name in ("time", "force", "stress") if name in force.values]
    values: dict[str, Array] = {name: force.values[name][every] for name in kept}
    places = np.searchsorted(every, rows)
    for name in STRAIN_CHANNELS:
        if name in strain.values:
            values[name] = np.full(len(every), np.nan)
            values[name][places] = strain.values[name][frames]
    signals = Signals(values)
    signals.failure_seen = end is not None
    _extend_to_peak(signals, every.astype(float), "rows")
    signals.note("pairing", how, rows=len(every), frames=len(frames))
    return signals


def _failure(table: RawFile, force_drop: float) -> int | None:
    """First row after failure of a file with a force or stress."""
    load = table.values.get("force", table.values.get("stress"))
    assert load is not None
    names = ("displacement", "extension", "strain")
    travel = next((table.values[name] for name in names if name in table.values), None)
    return failure_row(load, travel, force_drop, table.values.get("time"))


def _extend_to_peak(signals: Signals, position: Array, unit: str) -> None:
    """Extend the strains to the largest force by the line of the last frames, and say so."""
    load = signals.values["force" if "force" in signals.values else "stress"]
    peak = int(np.nanargmax(np.abs(load)))
    extended = 0.0
    for name in STRAIN_CHANNELS:
        readings = signals.values.get(name)
        if readings is None or not np.isnan(readings[peak]):
            continue
        frames = np.flatnonzero(~np.isnan(readings[:peak]))[-_FRAMES_EXTENDED:]
        if len(frames) < _FRAMES_EXTENDED:
            continue
        reach = position[peak] - position[frames[-1]]
        if not 0 <= reach <= 1.01 * np.median(np.diff(position[frames])):
            continue
        slope = np.polyfit(position[frames] - position[frames[-1]], readings[frames], 1)[0]
        readings[peak] = readings[frames[-1]] + slope * reach
        extended = float(reach)
    if extended:
        signals.flags.append(
            f"strain at the largest force extended from the last {_FRAMES_EXTENDED} frames before "
            f"it, by {extended:.3g} {unit}"
        )


def _by_time(
    force: RawFile,
    strain: RawFile,
    offset_s: float | None,
    shared: bool,
    settings: Pairing,
    specimen: str,
    force_drop: float,
) -> Signals:
    for table in (force, strain):
        _require_growing_time(table, specimen)
    how = "stated in the sheet"
    if offset_s is None and shared:
        offset_s, how = offset_by_force(force, strain), "from the force that both recorded"
    elif offset_s is None:
        offset_s, how = 0.0, "one clock, onsets of loading agree"
        _require_equal_onset(force, strain, settings, specimen)
    end = _failure(force, force_drop)
    signals = Signals(_merge(force, strain, offset_s, end))
    signals.failure_seen = end is not None
    _extend_to_peak(signals, signals.values["time"], "s")
    if shared and ends_before_peak(force, strain, settings.force_tolerance):
        signals.flags.append(
            f"the strain record ends at {abs(largest(strain.values['force'])):.5g} N of "
            f"{abs(largest(force.values['force'])):.5g} N"
        )
    if len(signals) < FEWEST_COMMON_ROWS:
        raise InputError(
            f"only {len(signals)} rows overlap in time",
            "give time_offset_s in the sheet, or check that both belong to one specimen",
            strain.path,
            specimen=specimen,
        )
    signals.note(
        "pairing",
        f"by time, {how}; force {_rate(force):.3g} Hz, strain {_rate(strain):.3g} Hz",
        offset_s=offset_s,
        rows=len(signals),
    )
    return signals


def _rate(table: RawFile) -> float:
    return float(1 / np.median(np.diff(table.values["time"])))


def _require_growing_time(table: RawFile, specimen: str) -> None:
    time = table.values["time"]
    bad = ~(np.diff(time) > 0)
    if bad.any():
        first = int(np.argmax(bad)) + 1
        raise InputError(
            f"time does not increase from reading {first} to {first + 1}",
            "delete the reading, or export one test per file",
            table.path,
            column=table.columns["time"],
            specimen=specimen,
            value=float(time[first]),
        )


def _require_equal_onset(force: RawFile, strain: RawFile, settings: Pairing, specimen: str) -> None:
    name = max(
        (channel for channel in STRAIN_CHANNELS if channel in strain.values),
        key=lambda channel: float(np.nanmax(np.abs(strain.values[channel]))),
    )
    load = "force" if "force" in force.values else "stress"
    ours, length = _onset(force, load, specimen)
    theirs, _ = _onset(strain, name, specimen)
    if abs(ours - theirs) > settings.clock_tolerance * length:
        raise InputError(
            f"loading begins at {theirs:.2f} s here and at {ours:.2f} s in {force.path.name}",
            f"give time_offset_s in the sheet (about {ours - theirs:.2f})",
            strain.path,
            column=strain.columns[name],
            specimen=specimen,
        )


def _onset(table: RawFile, name: str, specimen: str) -> tuple[float, float]:
    """Where the line through 5–25 % of the rise meets the level before loading; time to peak."""
    kept = ~np.isnan(table.values[name])
    time, signal = table.values["time"][kept], table.values[name][kept]
    signal = signal * np.sign(largest(signal))
    peak = int(np.argmax(signal))
    start = float(np.median(signal[:3]))
    rise = (signal[: peak + 1] - start) / ((signal[peak] - start) or 1.0)
    last = int(np.argmax(rise > 0.25))
    first = int(np.max(np.flatnonzero(rise[:last] < 0.05), initial=0))
    if last <= first:
        raise InputError(
            f"{name} does not rise from its start to its peak: no onset of loading",
            "give time_offset_s in the sheet, or check the column",
            table.path,
            column=table.columns[name],
            specimen=specimen,
        )
    rows = slice(first, last + 1)
    slope, level = np.polyfit(time[rows] - time[first], rise[rows], 1)
    return float(time[first] - level / slope), float(time[peak] - time[first])


def _merge(force: RawFile, strain: RawFile, offset_s: float, end: int | None) -> dict[str, Array]:
    """Interpolate onto the slower file's times up to failure, and onto that of the peak."""
    strain_time = strain.values["time"] + offset_s
    force_time = force.values["time"][:end]
    load = "force" if "force" in force.values else "stress"
    peak = force_time[int(np.nanargmax(np.abs(force.values[load][:end])))]
    frames = strain_time <= force_time[-1]
    slower = strain_time if _rate(strain) <= _rate(force) else force_time
    inside = (slower >= force_time[0]) & (slower <= force_time[-1])
    time = np.union1d(slower[inside], [peak])
    merged = {"time": time}
    for name in ("force", "stress"):
        if name in force.values:
            merged[name] = _resample(time, force_time, force.values[name][:end])
    for name in STRAIN_CHANNELS:
        if name in strain.values:
            merged[name] = _resample(time, strain_time[frames], strain.values[name][frames])
    return merged


def _resample(time: Array, known: Array, readings: Array) -> Array:
    """Interpolate linearly; NaN outside and where the neighbours are far apart."""
    kept = ~np.isnan(readings)
    if kept.sum() < 2:
        return np.full(len(time), np.nan)
    known, readings = known[kept], readings[kept]
    result = np.interp(time, known, readings, left=np.nan, right=np.nan)
    right = np.clip(np.searchsorted(known, time), 1, len(known) - 1)
    exact = np.isin(time, known)
    gap = known[right] - known[right - 1] > 3 * np.median(np.diff(known))
    result[gap & ~exact] = np.nan
    return result
