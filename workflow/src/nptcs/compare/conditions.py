"""The conditions under which the paper made its tables; other results are not compared with them.

A coefficient that holds at 5000 N says nothing about a study at 4000 N, nor does one that was
fitted over another range. Where a study differs, the published values are left out and the reason
is given.
"""

from __future__ import annotations

import math
from collections.abc import Mapping

from nptcs.config.studies.study import MeasuredRubber, Study
from nptcs.tables.solver_names import PUBLISHED

PAPER_LOAD_N = 5000.0
PAPER_RANGES: Mapping[str, tuple[float, float]] = {
    "spacing_mm": (10.0, 20.0),
    "thickness_mm": (1.2, 2.4),
    "angle_deg": (0.0, 90.0),
    "shear_band_c10_mpa": (4.0, 5.0),
    "spoke_c10_mpa": (1.0, 5.0),
}
"""Lowest and highest level of tables 5 and 7."""
PAPER_PLATES: Mapping[str, float] = {"spacing_mm": 15.0, "thickness_mm": 1.8, "angle_deg": 45.0}
"""Fiducial plates, which are the same throughout tables 7, 8, 10 and 11."""


def load_fault(study: Study) -> str:
    """Say how the load differs from that of the published tables; empty if it does not."""
    options = study.solver_options.get(PUBLISHED, {})
    load_n = float(options.get("archive_load_n", PAPER_LOAD_N))
    if math.isclose(study.load_n, load_n):
        return ""
    return (
        f"the published values hold at {load_n:g} N, the study {study.name} at {study.load_n:g} N"
    )


def range_faults(study: Study) -> list[str]:
    """Say which factors of a study have another range than in the published tables."""
    faults = []
    for factor in study.factors:
        if factor.name not in PAPER_RANGES:
            faults.append(f"the published tables do not vary {factor.label}")
            continue
        low, high = PAPER_RANGES[factor.name]
        first, last = factor.levels[0], factor.levels[-1]
        if isinstance(first, MeasuredRubber) or isinstance(last, MeasuredRubber):
            faults.append(f"{factor.label} has the levels of tested rubbers")
        elif not (math.isclose(first, low) and math.isclose(last, high)):
            faults.append(
                f"{factor.label} spans {low:g} to {high:g} {factor.unit} in the published tables, "
                f"{first:g} to {last:g} {factor.unit} in the study {study.name}"
            )
    return faults


def plate_faults(study: Study) -> list[str]:
    """Say which plates a study holds fixed that are not the paper's fiducial ones."""
    return [
        f"{name} is {value:g} in the published tables, {study.fixed[name]:g} in the study "
        f"{study.name}"
        for name, value in PAPER_PLATES.items()
        if name in study.fixed
        and not isinstance(study.fixed[name], MeasuredRubber)
        and not math.isclose(float(study.fixed[name]), value)  # type: ignore[arg-type]
    ]


def surface_faults(study: Study) -> list[str]:
    """Say why published coefficients and impact values are not those of a study; [] if they are."""
    load = load_fault(study)
    return [*([load] if load else []), *range_faults(study), *plate_faults(study)]
