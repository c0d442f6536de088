"""Flexure of laminates: ASTM D7264, ASTM D790 and ISO 14125."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pandas as pd

from nptcs.bending import BentBar
from nptcs.config.materials.reduction import FlexureRules
from nptcs.reduce.curve.branch import Branch
from nptcs.reduce.curve.evidence import Evidence
from nptcs.reduce.rows import Property, missing, strain_range, value_at_peak
from nptcs.reduce.standards.tension import modulus

LARGE_DEFLECTION = 0.1
"""Deflection over span beyond which the small-deflection formula overstates the stress."""
STRAINS_OF_A_SENSOR = ("strain_gauge", "dic")


def reduce_flexure(
    branch: Branch,
    rules: FlexureRules,
    bar: BentBar,
    strain_source: str,
    evidence: Evidence,
) -> list[Property]:
    """Flexural modulus, strength and strain at failure.

    The curve contains stress and strain of the outer face (`nptcs.bending.BentBar`). Modulus:
    chord Δσ/Δε. Strength: the largest stress, corrected for a large deflection where the standard
    says how and the deflection is known.

    Parameters
    ----------
    branch : Branch
        Chosen loading and record: stress_mpa, strain_axial.
    rules : FlexureRules
        Section of the standard in force.
    bar : BentBar
        Section and spans.
    strain_source : str
        Where the strain came from; a strain gauge or DIC gives no deflection.
    evidence : Evidence
        Whether the bar failed.
    """
    low, high = rules.chord_range
    nominal, words = strain_range(low, high), f", {bar.words()}"
    slope = modulus(branch.rows, rules, low, high, nominal, "flexural_modulus", words)
    measured = strain_source in STRAINS_OF_A_SENSOR
    failure = _at_failure(branch.to_peak, rules, bar, measured, evidence)
    remarks = _remarks(rules, bar)
    return [p.flagged(remarks) for p in (slope, *failure)]


def _at_failure(
    to_peak: pd.DataFrame, rules: FlexureRules, bar: BentBar, measured: bool, evidence: Evidence
) -> list[Property]:
    rule = f"{rules.title}, largest force, {bar.words()}"
    rows = (("flexural_strength", "MPa"), ("flexural_strain_at_failure", "1"))
    if not evidence.failed:
        return [missing(name, unit, rule, evidence.reason) for name, unit in rows]
    stress, strain = (value_at_peak(to_peak, name) for name in ("stress_mpa", "strain_axial"))
    flags = evidence.remarks
    strength = Property("flexural_strength", stress, "MPa", rule, points=1, flags=flags)
    if not np.isfinite(strain):
        last = to_peak["strain_axial"].max()
        lost = missing(*rows[1], rule, f"strain recorded up to {last:.4g} only")
        return [strength.flagged(["large deflection not assessed: no strain there"]), lost]
    at_failure = Property(rows[1][0], strain, "1", rule, points=1)
    if measured:
        words = "large deflection not assessed: the strain is not that of a deflection"
        return [strength.flagged([words]), at_failure]
    return [_corrected(strength, strain, rules, bar), at_failure]


def _corrected(strength: Property, strain: float, rules: FlexureRules, bar: BentBar) -> Property:
    """Multiply by 1 + a (D/L)² + b (h/L)(D/L) where D/L is large and the standard gives a, b."""
    deflection = strain / (bar.strain_per_deflection * bar.span_mm)
    if deflection <= LARGE_DEFLECTION:
        return strength
    words = f"deflection {deflection:.3g} of the span"
    if rules.large_deflection is None or bar.points != 3:
        return strength.flagged([f"{words}: {rules.title} gives no correction for this loading"])
    square, product = rules.large_deflection
    slenderness = bar.thickness_mm / bar.span_mm
    factor = 1 + square * deflection**2 + product * slenderness * deflection
    return replace(
        strength,
        value=strength.value * factor,
        rule=f"{strength.rule}, corrected for large deflection",
        flags=(*strength.flags, f"{words}: stress multiplied by {factor:.4g}"),
    )


def _remarks(rules: FlexureRules, bar: BentBar) -> list[str]:
    found = []
    ratio, limits = bar.span_mm / bar.thickness_mm, rules.span_to_thickness
    if limits is not None and not limits[0] <= ratio <= limits[1]:
        found.append(
            f"span to thickness {ratio:.3g}, {rules.title} expects {limits[0]:g} to "
            f"{limits[1]:g}: shear lowers the modulus of a short span"
        )
    share = bar.loading_span_mm / bar.span_mm
    if not any(abs(share - allowed) <= 0.01 for allowed in rules.loading_spans):
        allowed = " or ".join(f"{one:.3g}" for one in rules.loading_spans)
        found.append(f"loading span {share:.3g} of the span, {rules.title} specifies {allowed}")
    return found
