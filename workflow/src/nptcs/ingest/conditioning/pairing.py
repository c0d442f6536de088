"""Force and strain from two files on common rows: by time, or by a force that both recorded."""

from __future__ import annotations

import numpy as np

from nptcs.arrays import Array
from nptcs.config.ingest import Pairing
from nptcs.errors import InputError
from nptcs.ingest.conditioning.signals import STRAIN_CHANNELS, Signals, largest
from nptcs.ingest.reading.raw_file import RawFile
from nptcs.ingest.reading.units import FACTORS

FEWEST_COMMON_ROWS = 5
FORCE_UNITS = ("N", "kN", "lbf", "kgf")
_LEVELS = np.linspace(0.1, 0.8, 15)


def pair(
    force: RawFile, strain: RawFile, offset_s: float | None, settings: Pairing, specimen: str
) -> Signals:
    """Bring the readings of two files to common rows.

    The rows are those of the slower file, so that no reading is counted twice; the reading of
    the largest force is added, so that no strength is lost between two camera frames. Between
    rows the faster file is interpolated linearly; nothing is extrapolated.

    Parameters
    ----------
    force, strain : RawFile
        The two files.
    offset_s : float or None
        Added to the strain file's time. None: from the force that both recorded, else 0 and
        the onsets of loading are compared.
    settings : Pairing
        Tolerances.
    specimen : str
        For messages.

    Raises
    ------
    InputError
        If nothing links the files, or the link contradicts itself.
    """
    shared = "force" in force.values and "force" in strain.values
    if shared and not strain.units["force"]:
        _settle_force_unit(force, strain, settings, specimen)
    if shared:
        _require_equal_force(force, strain, settings, specimen)
    if "time" in force.values and "time" in strain.values:
        return _by_time(force, strain, offset_s, shared, settings, specimen)
    if shared:
        return _by_force(force, strain)
    raise InputError(
        "strain and force cannot be paired: the files share neither time nor force",
        "export the time in both, or the force as analog channel in the strain file",
        strain.path,
        specimen=specimen,
    )


def _settle_force_unit(force: RawFile, strain: RawFile, settings: Pairing, specimen: str) -> None:
    """Tell the unit of the strain file's force from the peak that both files recorded."""
    ours, theirs = abs(largest(force.values["force"])), abs(largest(strain.values["force"]))
    fitting = {
        unit: abs(theirs * FACTORS["force"][unit] / ours - 1)
        for unit in FORCE_UNITS
        if abs(theirs * FACTORS["force"][unit] / ours - 1) <= settings.force_tolerance
    }
    if len(fitting) != 1:
        raise InputError(
            f"force has no unit, and its peak {theirs:.6g} fits the machine's {ours:.6g} N in "
            f"{' and '.join(fitting) or 'none of ' + ', '.join(FORCE_UNITS)}",
            "state the unit in a profile, or check that both files belong to one specimen",
            strain.path,
            None,
            strain.columns["force"],
            specimen,
        )
    unit = next(iter(fitting))
    strain.units["force"] = unit
    strain.values["force"] = strain.values["force"] * FACTORS["force"][unit]
    strain.notes = (*strain.notes, f"force: taken as {unit}, its peak is the machine's")


def _require_equal_force(force: RawFile, strain: RawFile, settings: Pairing, specimen: str) -> None:
    ours, theirs = largest(force.values["force"]), largest(strain.values["force"])
    difference = abs(abs(theirs) / abs(ours) - 1) if ours else np.inf
    if difference > settings.force_tolerance:
        raise InputError(
            f"largest force is {theirs:.6g} N (read as {strain.units['force']}) here and "
            f"{ours:.6g} N (read as {force.units['force']}) in {force.path.name}",
            "check the force units (profile: wrong_units), or that both belong to one specimen; "
            "pairing.force_tolerance is the allowed difference",
            strain.path,
            None,
            strain.columns["force"],
            specimen,
        )


def _by_force(force: RawFile, strain: RawFile) -> Signals:
    """Take the strain file's own force; add the machine's peak where the camera missed it."""
    values = dict(strain.values)
    signals = Signals(values)
    peak, own = largest(force.values["force"]), largest(values["force"])
    if abs(peak) > abs(own):
        row = {name: np.nan for name in values} | {"force": peak}
        signals.values = {name: np.append(array, row[name]) for name, array in values.items()}
    signals.note(
        "pairing",
        f"by the force in {strain.path.name} (one of the files has no time); "
        f"peak force from {force.path.name}",
        rows=len(signals),
        peak_difference_percent=100 * (abs(peak) / abs(own) - 1),
    )
    return signals


def _by_time(
    force: RawFile,
    strain: RawFile,
    offset_s: float | None,
    shared: bool,
    settings: Pairing,
    specimen: str,
) -> Signals:
    for table in (force, strain):
        _require_growing_time(table, specimen)
    how = "stated in the sheet"
    if offset_s is None and shared:
        offset_s, how = _offset_by_force(force, strain), "from the force that both recorded"
    elif offset_s is None:
        offset_s, how = 0.0, "one clock, onsets of loading agree"
        _require_equal_onset(force, strain, settings, specimen)
    signals = Signals(_merge(force, strain, offset_s))
    if len(signals) < FEWEST_COMMON_ROWS:
        raise InputError(
            f"only {len(signals)} rows are common in time",
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
            f"time does not grow from reading {first} to {first + 1}",
            "delete the reading, or export one test a file",
            table.path,
            column=table.columns["time"],
            specimen=specimen,
            value=float(time[first]),
        )


def _offset_by_force(force: RawFile, strain: RawFile) -> float:
    """Median difference of the times at which both reach the same forces."""
    peak = min(abs(largest(table.values["force"])) for table in (force, strain))
    ours = _times_at(force.values["time"], force.values["force"], _LEVELS * peak)
    theirs = _times_at(strain.values["time"], strain.values["force"], _LEVELS * peak)
    return float(np.median(ours - theirs))


def _times_at(time: Array, signal: Array, levels: Array) -> Array:
    """Find the times at which the magnitude of a signal first reaches some levels."""
    kept = ~np.isnan(signal)
    rising = np.maximum.accumulate(signal[kept] * np.sign(largest(signal)))
    first = np.concatenate([[True], np.diff(rising) > 0])
    return np.interp(levels, rising[first], time[kept][first])


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


def _merge(force: RawFile, strain: RawFile, offset_s: float) -> dict[str, Array]:
    """Interpolate onto the slower file's times, and onto the time of the largest force."""
    strain_time = strain.values["time"] + offset_s
    force_time = force.values["time"]
    load = "force" if "force" in force.values else "stress"
    peak = force_time[int(np.nanargmax(np.abs(force.values[load])))]
    slower = strain_time if _rate(strain) <= _rate(force) else force_time
    inside = (slower >= force_time[0]) & (slower <= force_time[-1])
    time = np.union1d(slower[inside], [peak])
    merged = {"time": time}
    for name in ("force", "stress"):
        if name in force.values:
            merged[name] = _resample(time, force_time, force.values[name])
    for name in STRAIN_CHANNELS:
        if name in strain.values:
            merged[name] = _resample(time, strain_time, strain.values[name])
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
