"""Tension of laminates: ASTM D3039 and ISO 527-4/-5."""

from __future__ import annotations

import pandas as pd

from nptcs.config.reduction import ChordRules, TensionRules
from nptcs.reduce.chord import chord_slope
from nptcs.reduce.rows import (
    NAN,
    Property,
    chord_rule,
    finite_pair,
    from_chord,
    missing,
    strain_range,
    value_at_peak,
)


def reduce_tension(branch: pd.DataFrame, rules: TensionRules) -> list[Property]:
    """Modulus, Poisson's ratio, strength and ultimate strain of a tension test.

    σ = P/A (ASTM D3039, 13.1), E = Δσ/Δε (13.3.1), ν = -Δε_t/Δε_l (13.4.1), all slopes over
    one strain range. Where the ultimate strain is below ``low_ultimate_strain`` the range is
    25 to 50 % of the ultimate strain (D3039, table 3 footnote), as happens to 90° specimens.

    Parameters
    ----------
    branch : DataFrame
        Loading branch: stress_mpa, strain_axial, strain_transverse.
    rules : TensionRules
        Section of the standard in force.
    """
    low, high, nominal = chord_limits(branch, rules)
    return [
        modulus(branch, rules, low, high, nominal),
        poisson_ratio(branch, rules, low, high, nominal),
        strength(branch, rules.title),
        ultimate_strain(branch, rules.title),
    ]


def chord_limits(branch: pd.DataFrame, rules: TensionRules) -> tuple[float, float, str]:
    """Return the ends of the chord and their words, with the rule for low ultimate strains."""
    ultimate = value_at_peak(branch, "strain_axial")
    limit = rules.low_ultimate_strain
    if limit is not None and ultimate < limit:
        low, high = (fraction * ultimate for fraction in rules.low_ultimate_fractions)
        begin, end = (100.0 * fraction for fraction in rules.low_ultimate_fractions)
        return low, high, f"{begin:g} to {end:g} % of the ultimate strain (below {limit:g})"
    low, high = rules.chord_range
    return low, high, strain_range(low, high)


def modulus(
    branch: pd.DataFrame, rules: ChordRules, low: float, high: float, nominal: str
) -> Property:
    """Chord modulus E = Δσ/Δε (MPa)."""
    strain, stress = finite_pair(branch, "strain_axial", "stress_mpa")
    chord = chord_slope(strain, stress, low, high, rules.chord_method, rules.end_tolerance)
    rule = chord_rule(rules.title, rules.chord_method)
    return from_chord("modulus", chord, "MPa", rule, nominal)


def poisson_ratio(
    branch: pd.DataFrame, rules: ChordRules, low: float, high: float, nominal: str
) -> Property:
    """Poisson's ratio ν = -Δε_t/Δε_l over the range of the modulus."""
    rule = chord_rule(rules.title, rules.chord_method)
    axial, transverse = finite_pair(branch, "strain_axial", "strain_transverse")
    if not len(axial):
        return missing("poisson_ratio", "1", rule, "no transverse strain")
    chord = chord_slope(axial, -transverse, low, high, rules.chord_method, rules.end_tolerance)
    return from_chord("poisson_ratio", chord, "1", rule, nominal)


def strength(branch: pd.DataFrame, title: str) -> Property:
    """Strength F = P_max/A (MPa)."""
    value = value_at_peak(branch, "stress_mpa")
    return Property("strength", value, "MPa", f"{title}, largest force", points=1)


def ultimate_strain(branch: pd.DataFrame, title: str) -> Property:
    """Axial strain at the largest force."""
    rule = f"{title}, strain at the largest force"
    value = value_at_peak(branch, "strain_axial")
    if value == value:
        return Property("ultimate_strain", value, "1", rule, points=1)
    last = branch["strain_axial"].max()
    where = "no axial strain" if last != last else f"strain recorded up to {last:.4g} only"
    return Property("ultimate_strain", NAN, "1", rule, flags=(f"not assessed: {where}",))
