"""In-plane shear by tension of a ±45° laminate: ASTM D3518 and ISO 14129."""

from __future__ import annotations

import numpy as np
import pandas as pd

from nptcs.arrays import Array
from nptcs.config.materials.reduction import ShearRules
from nptcs.reduce.curve.branch import Branch
from nptcs.reduce.curve.chord import Chord, chord_slope, not_assessed
from nptcs.reduce.curve.evidence import Evidence
from nptcs.reduce.curve.toe import toe_words
from nptcs.reduce.rows import Property, chord_rule, from_chord, missing, strain_range, value_at_peak
from nptcs.reduce.standards.tension import no_slope

NO_STRAIN = "shear strain needs axial and transverse strain"


def reduce_shear(branch: Branch, rules: ShearRules, evidence: Evidence) -> list[Property]:
    """Shear modulus, offset strength, shear strength and largest shear strain.

    τ12 = P/(2A), γ12 = ε_x - ε_y (ASTM D3518, 12.1 and 12.2); G12 = Δτ/Δγ (12.3.1); offset
    strength: where the line of slope G12 through γ = 0.002 cuts the curve (12.4); shear
    strength: the largest τ at γ ≤ 0.05, where the curve is cut.

    Parameters
    ----------
    branch : Branch
        Chosen loading and record: stress_mpa (P/A), strain_axial, strain_transverse.
    rules : ShearRules
        Section of the standard in force.
    evidence : Evidence
        Whether the specimen failed; a curve that is cut at γ = 0.05 needs no failure.
    """
    gamma, tau = shear_curve(branch.rows)
    chord_words = chord_rule(rules.title, rules.chord_method)
    nominal = f"shear {strain_range(*rules.chord_range)}"
    if not len(gamma):
        names = {"shear_modulus": "MPa", "offset_shear_strength": "MPa", "shear_strength": "MPa"}
        rows = [missing(name, unit, rules.title, NO_STRAIN) for name, unit in names.items()]
        return [*rows, missing("ultimate_shear_strain", "1", rules.title, NO_STRAIN)]
    low, high = rules.chord_range
    chord = chord_slope(gamma, tau, low, high, rules.chord_method, rules.end_tolerance)
    modulus = from_chord("shear_modulus", chord, "MPa", chord_words, nominal)
    modulus = modulus.flagged(toe_words(gamma, tau, low, high))
    if reason := no_slope(gamma, tau, low, high):
        chord = not_assessed(reason)
        modulus = missing("shear_modulus", "MPa", chord_words, reason)
    return [
        modulus.flagged(chord_deviations(chord, rules)),
        offset_strength(gamma, tau, chord, rules),
        *strength_rows(branch.to_peak, rules, evidence),
    ]


def shear_curve(branch: pd.DataFrame) -> tuple[Array, Array]:
    """γ12 = ε_x - ε_y and τ12 = σ_x/2 (MPa), rows without both strains left out."""
    rows = branch[["stress_mpa", "strain_axial", "strain_transverse"]].dropna()
    gamma = (rows["strain_axial"] - rows["strain_transverse"]).to_numpy(dtype=float)
    return gamma, rows["stress_mpa"].to_numpy(dtype=float) / 2


def chord_deviations(chord: Chord, rules: ShearRules) -> list[str]:
    """Words where the recorded chord is outside what the standard allows."""
    flags = []
    limits = (
        ("starts at", chord.x_low, rules.chord_start),
        ("spans", chord.x_high - chord.x_low, rules.chord_width),
    )
    for words, value, allowed in limits:
        # 1e-9 of strain: far below what any sensor resolves, far above rounding
        if allowed and value == value and not allowed[0] - 1e-9 <= value <= allowed[1] + 1e-9:
            low, high = allowed
            flags.append(f"chord {words} {value:.4g}, {rules.title} requires {low:g} to {high:g}")
    return flags


def offset_strength(gamma: Array, tau: Array, chord: Chord, rules: ShearRules) -> Property:
    """Shear stress at which the line τ = G (γ - offset) cuts the curve."""
    name, rule = "offset_shear_strength", f"{rules.title}, offset {rules.offset_strain}"
    if rules.offset_strain is None:
        return missing(name, "MPa", rules.title, "the standard defines no offset strength")
    if chord.slope != chord.slope:
        return missing(name, "MPa", rule, "no shear modulus")
    below = tau - chord.slope * (gamma - rules.offset_strain)
    crossings = np.flatnonzero((below[:-1] > 0) & (below[1:] <= 0) & (gamma[1:] > chord.x_low))
    if not crossings.size:
        return missing(name, "MPa", rule, f"not reached before shear strain {gamma.max():.4g}")
    i = int(crossings[0])
    share = below[i] / (below[i] - below[i + 1])
    value = float(tau[i] + share * (tau[i + 1] - tau[i]))
    gamma_at = float(gamma[i] + share * (gamma[i + 1] - gamma[i]))
    flags: tuple[str, ...] = ()
    if gamma_at > rules.largest_shear_strain:
        flags = (f"at shear strain {gamma_at:.3g}, beyond {rules.largest_shear_strain:g}",)
    return Property(name, value, "MPa", rule, points=2, flags=flags, range_high=gamma_at)


def strength_rows(to_peak: pd.DataFrame, rules: ShearRules, evidence: Evidence) -> list[Property]:
    """Rows ``shear_strength`` and ``ultimate_shear_strain``, the curve cut at γ = 0.05."""
    gamma, tau = shear_curve(to_peak)
    limit = rules.largest_shear_strain
    beyond = np.flatnonzero(gamma > limit)
    end = int(beyond[0]) if beyond.size else len(gamma)
    rule = f"{rules.title}, largest stress up to shear strain {limit:g}"
    names = (("shear_strength", "MPa"), ("ultimate_shear_strain", "1"))
    if not beyond.size and not evidence.failed:
        return [missing(n, unit, rule, evidence.reason) for n, unit in names]
    if end == 0:
        return [missing(n, unit, rule, f"the curve begins after {limit:g}") for n, unit in names]
    peak = int(np.argmax(tau[:end]))
    value, strain = float(tau[peak]), float(gamma[peak])
    flags = evidence.remarks
    if beyond.size:
        value, strain = _at_limit(gamma, tau, end, limit, value, strain)
        if strain == limit:
            flags = (f"cut at shear strain {limit:g}: the stress was still rising",)
    elif value < 0.999 * value_at_peak(to_peak, "stress_mpa") / 2:
        flags = (f"strain recorded up to {gamma.max():.4g} only, the force rose further",)
    return [
        Property("shear_strength", value, "MPa", rule, points=1, flags=flags),
        Property("ultimate_shear_strain", strain, "1", rule, points=1, flags=flags),
    ]


def _at_limit(
    gamma: Array, tau: Array, end: int, limit: float, value: float, strain: float
) -> tuple[float, float]:
    """Stress interpolated at the limit, where it is the largest up to there."""
    share = (limit - gamma[end - 1]) / (gamma[end] - gamma[end - 1])
    at_limit = float(tau[end - 1] + share * (tau[end] - tau[end - 1]))
    return (at_limit, limit) if at_limit > value else (value, strain)
