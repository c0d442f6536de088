"""Tension of laminates: ASTM D3039 and ISO 527-4/-5."""

from __future__ import annotations

import pandas as pd

from nptcs.arrays import Array
from nptcs.config.materials.reduction import ChordRules, TensionRules
from nptcs.reduce.curve.branch import Branch
from nptcs.reduce.curve.chord import chord_slope
from nptcs.reduce.curve.evidence import Evidence
from nptcs.reduce.curve.faces import branch_of_faces
from nptcs.reduce.curve.leaps import leap_within
from nptcs.reduce.curve.toe import NO_LAMINATE, stiffening, toe_words
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

ANOTHER_RANGE = "chord over another range"


def reduce_tension(branch: Branch, rules: TensionRules, evidence: Evidence) -> list[Property]:
    """Modulus, Poisson's ratio, strength and ultimate strain of a tension test.

    σ = P/A (ASTM D3039, 13.1), E = Δσ/Δε (13.3.1), ν = -Δε_t/Δε_l (13.4.1), all slopes over
    one strain range. Where the ultimate strain is below ``low_ultimate_strain`` the range is
    25 to 50 % of the ultimate strain (D3039, table 3 footnote), as with 90° specimens.

    Parameters
    ----------
    branch : Branch
        Chosen loading and record: stress_mpa, strain_axial, strain_transverse.
    rules : TensionRules
        Section of the standard in force.
    evidence : Evidence
        Whether the specimen failed.
    """
    branch, faces = branch_of_faces(branch)
    ultimate = ultimate_strain(branch.to_peak, rules.title, evidence).flagged(faces)
    low, high, nominal = chord_limits(ultimate.value, rules)
    remarks = [*faces]
    if ultimate.value != ultimate.value and (short := _short_run(branch, rules, high)):
        last = branch.rows["strain_axial"].max()
        remarks.append(f"strain ends at {last:.4g}: {ANOTHER_RANGE} than {nominal}")
        (low, high), nominal = short, strain_range(*short)
    elif late := _late_start(branch, rules, low, high):
        remarks.append(f"strain begins at {late[0]:.4g}: {ANOTHER_RANGE} than {nominal}")
        (low, high), nominal = late, strain_range(*late)
    slopes = [
        modulus(branch.rows, rules, low, high, nominal),
        poisson_ratio(branch.rows, rules, low, high, nominal),
    ]
    if ultimate.value != ultimate.value and _may_be_low(branch, rules):
        words = f"ultimate strain not known, so it may be below {rules.low_ultimate_strain:g}"
        remarks.append(words)
    slopes = [row.flagged(remarks) for row in slopes]
    return [*slopes, strength(branch.to_peak, rules.title, evidence), ultimate]


def _short_run(branch: Branch, rules: TensionRules, high: float) -> tuple[float, float] | None:
    """Range of a run whose strain ends before `high`; None if it does not, or ends before both."""
    short, last = rules.short_run_range, float(branch.rows["strain_axial"].max())
    if short is None or last >= high - rules.end_tolerance * (high - rules.chord_range[0]):
        return None
    covered = last >= short[1] - rules.end_tolerance * (short[1] - short[0])
    return short if covered else None


def _late_start(
    branch: Branch, rules: TensionRules, low: float, high: float
) -> tuple[float, float] | None:
    """Range of equal width from where the strain begins, above the low end: after a preload.

    None if the strain begins early enough, or only beyond the range, or ends before it.
    """
    strain = branch.rows["strain_axial"].dropna()
    begin, end = float(strain.min()), float(strain.max())
    if not low + rules.end_tolerance * (high - low) < begin < high:
        return None
    return (begin, begin + high - low) if end >= begin + high - low else None


def _may_be_low(branch: Branch, rules: TensionRules) -> bool:
    """Whether no strain beyond the limit of the rule for low ultimate strains was recorded."""
    limit = rules.low_ultimate_strain
    return limit is not None and not branch.turned["strain_axial"].max() >= limit


def chord_limits(ultimate: float, rules: TensionRules) -> tuple[float, float, str]:
    """Return the ends of the chord and their words, with the rule for low ultimate strains.

    Parameters
    ----------
    ultimate : float
        Ultimate strain; NaN if it was not assessed, e.g. because the test was stopped before
        failure: then the rule for low ultimate strains is not used.
    rules : TensionRules
        Section of the standard in force.
    """
    limit = rules.low_ultimate_strain
    if limit is not None and ultimate < limit:
        low, high = (fraction * ultimate for fraction in rules.low_ultimate_fractions)
        begin, end = (100.0 * fraction for fraction in rules.low_ultimate_fractions)
        return low, high, f"{begin:g} to {end:g} % of the ultimate strain (below {limit:g})"
    low, high = rules.chord_range
    return low, high, strain_range(low, high)


def modulus(
    branch: pd.DataFrame,
    rules: ChordRules,
    low: float,
    high: float,
    nominal: str,
    name: str = "modulus",
    words: str = "",
) -> Property:
    """Chord modulus E = Δσ/Δε (MPa), called `name`; `words` follow its rule."""
    strain, stress = finite_pair(branch, "strain_axial", "stress_mpa")
    chord = chord_slope(strain, stress, low, high, rules.chord_method, rules.end_tolerance)
    rule = f"{chord_rule(rules.title, rules.chord_method)}{words}"
    if reason := no_slope(strain, stress, low, high):
        return missing(name, "MPa", rule, reason)
    found = from_chord(name, chord, "MPa", rule, nominal)
    return found.flagged(toe_words(strain, stress, low, high))


def no_slope(strain: Array, stress: Array, low: float, high: float) -> str:
    """Say why a curve has no slope in a range: a slip of the gauge, or slack; empty if it has."""
    if leap := leap_within(strain, stress, low, high):
        return leap
    if (ratio := stiffening(strain, stress, low, high)) > NO_LAMINATE:
        return (
            f"the curve stiffens by a factor of {ratio:.3g} within the range: slack or a toe "
            "remains"
        )
    return ""


def poisson_ratio(
    branch: pd.DataFrame, rules: ChordRules, low: float, high: float, nominal: str
) -> Property:
    """Poisson's ratio ν = -Δε_t/Δε_l over the range of the modulus."""
    rule = chord_rule(rules.title, rules.chord_method)
    axial, transverse = finite_pair(branch, "strain_axial", "strain_transverse")
    if not len(axial):
        return missing("poisson_ratio", "1", rule, "no transverse strain")
    if leap := leap_within(axial, -transverse, low, high, of_both=True):
        return missing("poisson_ratio", "1", rule, leap)
    chord = chord_slope(axial, -transverse, low, high, rules.chord_method, rules.end_tolerance)
    return from_chord("poisson_ratio", chord, "1", rule, nominal)


def strength(to_peak: pd.DataFrame, title: str, evidence: Evidence) -> Property:
    """Strength F = P_max/A (MPa) of a specimen that failed."""
    rule = f"{title}, largest force"
    if not evidence.failed:
        return missing("strength", "MPa", rule, evidence.reason)
    value = value_at_peak(to_peak, "stress_mpa")
    return Property("strength", value, "MPa", rule, points=1, flags=evidence.remarks)


def ultimate_strain(to_peak: pd.DataFrame, title: str, evidence: Evidence) -> Property:
    """Axial strain at the largest force of a specimen that failed."""
    rule = f"{title}, strain at the largest force"
    if not evidence.failed:
        return missing("ultimate_strain", "1", rule, evidence.reason)
    value = value_at_peak(to_peak, "strain_axial")
    if value == value:
        return Property("ultimate_strain", value, "1", rule, points=1, flags=evidence.remarks)
    last = to_peak["strain_axial"].max()
    where = "no axial strain" if last != last else f"strain recorded up to {last:.4g} only"
    return Property("ultimate_strain", NAN, "1", rule, flags=(f"not assessed: {where}",))
