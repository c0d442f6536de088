"""Deviations of a test from its standard: reported with every value, never a reason to hide it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
import pandas as pd

from nptcs.config.materials.reduction import ChordRules, RubberCompressionRules, RubberRules, Rules
from nptcs.loading import loadings
from nptcs.reduce.curve.branch import Branch
from nptcs.reduce.curve.chord import fit_line
from nptcs.reduce.curve.evidence import Evidence
from nptcs.reduce.rows import NAN, Property, finite_pair, missing
from nptcs.tables.laboratory.specimens import Specimen

CROSSHEAD = "crosshead strain"


def with_crosshead_strain(properties: pd.DataFrame) -> list[str]:
    """Ids of the specimens in a property table whose strain is crosshead travel."""
    said = properties["flags"].str.contains(CROSSHEAD, regex=False)
    return list(dict.fromkeys(properties.loc[said, "specimen"]))


def deviations(
    branch: Branch, specimen: Specimen, rules: Rules, strain_source: str, evidence: Evidence
) -> tuple[str, ...]:
    """Words for each deviation from the standard that the sheet and the curve show.

    Parameters
    ----------
    branch : Branch
        Chosen loading and record, with time_s and strain_axial.
    specimen : Specimen
        Row of the specimen sheet.
    rules : Rules
        Section of the standard in force.
    strain_source : str
        Where the strain came from, as the ingest record says ("extensometer", "dic",
        "crosshead"; "unspecified" or empty if not known).
    evidence : Evidence
        Whether the specimen failed; the time to failure is judged only then.
    """
    found = list(_source(strain_source))
    found += _size(specimen, rules)
    if isinstance(rules, ChordRules) and not evidence.not_seen:
        found += _duration(branch.to_peak, rules)
    if isinstance(rules, RubberRules):
        found += _speed(branch.rows, specimen, rules)
    if isinstance(rules, RubberCompressionRules):
        found += _disc(branch, specimen, rules)
    return tuple(found)


def _source(strain_source: str) -> Iterator[str]:
    if strain_source == "crosshead":
        yield f"{CROSSHEAD}: it includes the compliance of machine and grips"
    elif strain_source in ("", "unspecified"):
        yield "source of the strain not stated"


def _size(specimen: Specimen, rules: Rules) -> Iterator[str]:
    key = 0 if specimen.orientation_deg is None else round(abs(specimen.orientation_deg))
    sizes = (
        ("width", specimen.width_mm, rules.expected_width_mm.get(key)),
        ("thickness", specimen.thickness_mm, rules.expected_thickness_mm.get(key)),
    )
    for name, stations, expected in sizes:
        if not stations:
            if not specimen.diameter_mm:
                yield f"{name} not given, area: {specimen.area_rule}"
            continue
        mean = sum(stations) / len(stations)
        if expected is not None and not expected[0] <= mean <= expected[1]:
            low, high = expected
            yield f"{name} {mean:.4g} mm, {rules.title} recommends {low:g} to {high:g} mm"
        if len(stations) < rules.stations:
            yield f"{name} measured at {len(stations)} of {rules.stations} stations"


def _duration(branch: pd.DataFrame, rules: ChordRules) -> Iterator[str]:
    limits, minutes = rules.time_to_failure_min, time_to_failure(branch)
    if limits is not None and np.isfinite(minutes) and not limits[0] <= minutes <= limits[1]:
        low, high = limits
        yield f"failure after {minutes:.3g} min, {rules.title} requires {low:g} to {high:g} min"


def _speed(branch: pd.DataFrame, specimen: Specimen, rules: RubberRules) -> Iterator[str]:
    limits, length = rules.gauge_speed_mm_per_min, specimen.gauge_length_mm
    if limits is None or length is None:
        return
    speed = strain_rate(branch)[0] * length
    if np.isfinite(speed) and not limits[0] <= speed <= limits[1]:
        yield (
            f"the gauge length grows at {speed:.3g} mm/min, "
            f"{rules.title} (500 mm/min between the grips) expects "
            f"{limits[0]:g} to {limits[1]:g}"
        )


def _disc(branch: Branch, specimen: Specimen, rules: RubberCompressionRules) -> Iterator[str]:
    """Size of a disc, and its conditioning: only the last of several loadings is measured."""
    height = specimen.gauge_length_mm
    diameter = _mean(specimen.diameter_mm)
    sizes = (("diameter", diameter, rules.disc_mm[0]), ("height", height, rules.disc_mm[1]))
    for name, value, (low, high) in sizes:
        if value is not None and not low <= value <= high:
            yield f"{name} {value:.4g} mm, {rules.title} recommends {low:g} to {high:g} mm"
    turned = branch.turned
    count = len(loadings(*(turned[c].to_numpy(float) for c in ("stress_mpa", "strain_axial"))))
    if count < rules.loadings:
        yield f"{count} of {rules.loadings} loadings, {rules.title} measures the last"


def _mean(stations: tuple[float, ...]) -> float | None:
    return sum(stations) / len(stations) if stations else None


def time_to_failure(branch: pd.DataFrame) -> float:
    """Minutes from the first row to the largest force; NaN without times."""
    times = branch["time_s"].to_numpy(dtype=float)
    return float(times[-1] - times[0]) / 60.0 if np.isfinite(times[[0, -1]]).all() else NAN


def strain_rate(branch: pd.DataFrame) -> tuple[float, int]:
    """Mean axial strain rate (1/min, least squares over the branch) and its points."""
    times, strain = finite_pair(branch, "time_s", "strain_axial")
    if len(times) < 3 or np.ptp(times) == 0:
        return NAN, 0
    return fit_line(times / 60.0, strain).slope, len(times)


def speed_properties(branch: Branch, title: str, evidence: Evidence) -> list[Property]:
    """Rows ``strain_rate`` and ``time_to_failure``: the speed of the test, from the curve."""
    rate, points = strain_rate(branch.rows)
    minutes = time_to_failure(branch.to_peak)
    rule = f"{title}, from the curve"
    if not np.isfinite(rate):
        reason = "no usable times"
        return [
            missing("strain_rate", "1/min", rule, reason),
            missing("time_to_failure", "min", rule, reason),
        ]
    speed = Property("strain_rate", rate, "1/min", f"{rule}, least squares up to the peak")
    speed = replace(speed, points=points)
    if evidence.not_seen:
        return [speed, missing("time_to_failure", "min", rule, evidence.not_seen)]
    return [
        speed,
        Property("time_to_failure", minutes, "min", f"{rule}, first row to the peak", "", 2),
    ]
