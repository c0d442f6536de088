"""Tension of rubber: ASTM D412 and ISO 37."""

from __future__ import annotations

import numpy as np

from nptcs.arrays import Array
from nptcs.config.materials.reduction import RubberRules, Rules
from nptcs.reduce.curve.branch import Branch
from nptcs.reduce.curve.evidence import Evidence
from nptcs.reduce.rows import Property, finite_pair, missing, value_at_peak
from nptcs.reduce.standards.tension import strength, ultimate_strain


def reduce_rubber(branch: Branch, rules: RubberRules, evidence: Evidence) -> list[Property]:
    """Stress at given elongations, strength, elongation at break and strain energy density.

    Nominal stress F/A0 against nominal strain ΔL/L0 (ASTM D412, ISO 37); the strain energy
    density is ∫σ dε up to the largest force by the trapezoid rule, in MPa = MJ/m³.

    Parameters
    ----------
    branch : Branch
        Chosen loading and record: stress_mpa, strain_axial.
    rules : RubberRules
        Section of the standard in force.
    evidence : Evidence
        Whether the piece broke.
    """
    strain, stress = finite_pair(branch.rows, "strain_axial", "stress_mpa")
    return [
        *(stress_at(strain, stress, percent, rules) for percent in rules.elongations_percent),
        strength(branch.to_peak, rules.title, evidence),
        ultimate_strain(branch.to_peak, rules.title, evidence),
        strain_energy_density(branch, rules, evidence),
    ]


def stress_at(strain: Array, stress: Array, percent: float, rules: Rules) -> Property:
    """Nominal stress at an elongation, interpolated at the first passage."""
    name, target = f"stress_at_{percent:g}_percent", percent / 100.0
    rule = f"{rules.title}, interpolated at {percent:g} %"
    if not len(strain) or strain.max() < target:
        reached = f"{100 * strain.max():.4g} %" if len(strain) else "nothing"
        return missing(name, "MPa", rule, f"the curve reaches {reached}")
    after = int(np.argmax(strain >= target))
    if after == 0:
        return missing(name, "MPa", rule, f"the curve begins at {100 * strain[0]:.4g} %")
    share = (target - strain[after - 1]) / (strain[after] - strain[after - 1])
    value = float(stress[after - 1] + share * (stress[after] - stress[after - 1]))
    return Property(name, value, "MPa", rule, points=2)


def strain_energy_density(branch: Branch, rules: RubberRules, evidence: Evidence) -> Property:
    """∫σ dε of one loading up to the break (MJ/m³)."""
    name, rule = "strain_energy_density", f"{rules.title}, trapezoid rule up to the peak"
    if not evidence.failed:
        return missing(name, "MJ/m3", rule, evidence.reason)
    if not branch.reaches_peak:
        return missing(name, "MJ/m3", rule, "the loading that was taken is not the one that broke")
    if np.isnan(value_at_peak(branch.rows, "strain_axial")):
        return missing(name, "MJ/m3", rule, "the strain ends before the largest force")
    strain, stress = finite_pair(branch.rows, "strain_axial", "stress_mpa")
    if len(strain) < 2:
        return missing(name, "MJ/m3", rule, "fewer than two recorded points")
    low, high = float(strain[0]), float(strain[-1])
    return Property(
        name,
        float(np.trapezoid(stress, strain)),
        "MJ/m3",
        rule,
        "up to the largest force",
        len(strain),
        range_low=low,
        range_high=high,
    )
