"""A force recorded in both files: its unit, its agreement, and the offset of the clocks."""

from __future__ import annotations

import numpy as np

from nptcs.arrays import Array
from nptcs.config.materials.ingest import Pairing
from nptcs.errors import InputError
from nptcs.ingest.conditioning.signals import largest
from nptcs.ingest.reading.raw_file import RawFile
from nptcs.ingest.reading.units import FACTORS

FORCE_UNITS = ("N", "kN", "lbf", "kgf")
_LEVELS = np.linspace(0.1, 0.8, 15)
_STILL_UP = 0.9
_DRIFT = 0.02


def settle_force_unit(force: RawFile, strain: RawFile, settings: Pairing, specimen: str) -> None:
    """Determine the unit of the strain file's force from the force that the machine recorded.

    Raises
    ------
    InputError
        If none or several of `FORCE_UNITS` fit.
    """
    readings = strain.values["force"]
    fitting = [
        unit
        for unit in FORCE_UNITS
        if _agreement(force, strain, readings * FACTORS["force"][unit]) <= settings.force_tolerance
    ]
    if len(fitting) != 1:
        ours, theirs = abs(largest(force.values["force"])), abs(largest(readings))
        raise InputError(
            f"force has no unit, and its peak {theirs:.6g} fits the machine's {ours:.6g} N in "
            f"{' and '.join(fitting) or 'none of ' + ', '.join(FORCE_UNITS)}",
            "state the unit in a profile, or check that both files belong to one specimen",
            strain.path,
            None,
            strain.columns["force"],
            specimen,
        )
    strain.units["force"] = fitting[0]
    strain.values["force"] = readings * FACTORS["force"][fitting[0]]
    note = f"force: taken as {fitting[0]}, whose peak agrees with the machine's"
    strain.notes = (*strain.notes, note)


def scale_raw_force(force: RawFile, strain: RawFile, specimen: str) -> None:
    """Scale the camera's force in volts to the machine's by the peak, if the shapes agree.

    If both are the same signal, they reach each share of the peak a constant time apart; if the
    camera's record ends below the peak, or it is another signal, these times drift.

    Raises
    ------
    InputError
        If they drift by more than `_DRIFT` of the camera's record, or a file has no time.
    """
    readings = strain.values["force"] - np.nanmedian(strain.values["force"][:3])
    ours, theirs = largest(force.values["force"]), largest(readings)
    scaled = readings * (ours / theirs) if theirs else readings
    drift = np.inf
    if theirs and "time" in force.values and "time" in strain.values:
        apart = _times_apart(force, strain, scaled)
        drift = float(np.ptp(apart)) / float(np.ptp(strain.values["time"]) or 1.0)
    if not drift <= _DRIFT:
        raise InputError(
            f"force in {strain.units['force']} does not follow the machine's force",
            "state its unit in a profile under 'wrong_units', or leave the force column out of the "
            "profile and give time_offset_s in the sheet",
            strain.path,
            None,
            strain.columns["force"],
            specimen,
        )
    strain.notes = (*strain.notes, f"force: scaled by {abs(ours / theirs):.6g} N per unit")
    strain.values["force"] = scaled
    strain.units["force"] = "N"


def require_equal_force(force: RawFile, strain: RawFile, settings: Pairing, specimen: str) -> None:
    """Compare the force of both files: by the peak, or by the slope where one ends before it.

    Raises
    ------
    InputError
        If they differ by more than the tolerance.
    """
    if _agreement(force, strain, strain.values["force"]) > settings.force_tolerance:
        ours, theirs = largest(force.values["force"]), largest(strain.values["force"])
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


def ends_before_peak(force: RawFile, strain: RawFile, tolerance: float) -> bool:
    """Tell whether the strain record stops while the force still grows, below its maximum."""
    theirs = np.abs(strain.values["force"])
    theirs = theirs[~np.isnan(theirs)]
    ours = abs(largest(force.values["force"]))
    still_up = theirs[-1] >= _STILL_UP * theirs.max()
    return bool(still_up and theirs.max() < (1 - tolerance) * ours)


def _agreement(force: RawFile, strain: RawFile, theirs: Array) -> float:
    """Relative difference of the two forces: of their peaks, or of their slopes on each other."""
    ours = force.values["force"]
    ours_peak, peak = abs(largest(ours)), abs(largest(theirs))
    if not ours_peak or not peak:
        return np.inf
    difference = abs(peak / ours_peak - 1)
    timed = "time" in force.values and "time" in strain.values
    last = np.abs(theirs[~np.isnan(theirs)][-1])
    if peak < ours_peak and last >= _STILL_UP * peak and timed:
        difference = min(difference, _slope_difference(force, strain, theirs))
    return float(difference)


def _slope_difference(force: RawFile, strain: RawFile, theirs: Array) -> float:
    """Difference from 1 of the slope of one force on the other at equal times."""
    offset = _offset(force, strain, theirs)
    time = strain.values["time"] + offset
    ours_time, ours = force.values["time"], np.abs(force.values["force"])
    kept = ~np.isnan(ours)
    machine = np.interp(time, ours_time[kept], ours[kept], left=np.nan, right=np.nan)
    theirs = np.abs(theirs)
    rows = (theirs > 0.1 * np.nanmax(theirs)) & ~np.isnan(machine)
    if rows.sum() < 5 or not np.ptp(machine[rows]):
        return np.inf
    return abs(float(np.polyfit(machine[rows], theirs[rows], 1)[0]) - 1)


def offset_by_force(force: RawFile, strain: RawFile) -> float:
    """Median difference of the times at which both reach the same forces, in s."""
    return _offset(force, strain, strain.values["force"])


def _offset(force: RawFile, strain: RawFile, theirs: Array) -> float:
    return float(np.median(_times_apart(force, strain, theirs)))


def _times_apart(force: RawFile, strain: RawFile, theirs: Array) -> Array:
    """Differences of the times at which both forces first reach the same levels, in s."""
    peak = min(abs(largest(readings)) for readings in (force.values["force"], theirs))
    ours_at = _times_at(force.values["time"], force.values["force"], _LEVELS * peak)
    theirs_at = _times_at(strain.values["time"], theirs, _LEVELS * peak)
    return ours_at - theirs_at


def _times_at(time: Array, signal: Array, levels: Array) -> Array:
    """Find the times at which the magnitude of a signal first reaches some levels."""
    kept = ~np.isnan(signal)
    rising = np.maximum.accumulate(signal[kept] * np.sign(largest(signal)))
    first = np.concatenate([[True], np.diff(rising) > 0])
    return np.interp(levels, rising[first], time[kept][first])
