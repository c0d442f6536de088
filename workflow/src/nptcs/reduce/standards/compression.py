"""Compression of laminates: ASTM D6641 (combined loading)."""

from __future__ import annotations

import numpy as np

from nptcs.config.materials.reduction import AstmD6641
from nptcs.reduce.curve.branch import Branch
from nptcs.reduce.curve.evidence import Evidence
from nptcs.reduce.curve.faces import mean_of_faces
from nptcs.reduce.rows import Property, finite_pair, missing, strain_range, value_at_peak
from nptcs.reduce.standards.tension import modulus, poisson_ratio, strength, ultimate_strain


def reduce_compression(branch: Branch, rules: AstmD6641, evidence: Evidence) -> list[Property]:
    """Modulus, Poisson's ratio, strength, ultimate strain and bending of a compression test.

    F_cu = P_f/(w h); chord modulus on the mean of the strains of both faces; bending
    B_y = 100 (ε1 - ε2)/(ε1 + ε2) in the middle of the chord and at failure. All values are
    magnitudes. With strain on one face only, bending is "not assessed" and every value that
    depends on strain says so.

    Parameters
    ----------
    branch : Branch
        Chosen loading and record, turned over (compression positive), with strain_axial and,
        where both faces were measured, strain_axial_back.
    rules : AstmD6641
        Section of the standard.
    evidence : Evidence
        Whether the specimen failed.
    """
    low, high = rules.chord_range
    nominal = strain_range(low, high)
    bending = bending_rows(branch, rules, evidence)
    mean = mean_of_faces(branch.rows)
    from_strain = [
        modulus(mean, rules, low, high, nominal),
        poisson_ratio(mean, rules, low, high, nominal),
        ultimate_strain(mean_of_faces(branch.to_peak), rules.title, evidence),
    ]
    remarks = dict.fromkeys(_bending_remarks([flag for row in bending for flag in row.flags]))
    return [
        *(p.flagged(remarks) for p in from_strain),
        strength(branch.to_peak, rules.title, evidence),
        *bending,
    ]


def bending_rows(branch: Branch, rules: AstmD6641, evidence: Evidence) -> list[Property]:
    """Rows ``bending_percent`` (middle of the chord) and ``bending_at_failure_percent``."""
    names = ("bending_percent", "bending_at_failure_percent")
    rule = f"{rules.title}, B_y = 100 (e1 - e2)/(e1 + e2)"
    front, back = finite_pair(branch.rows, "strain_axial", "strain_axial_back")
    if not len(front):
        reason = "strain on one face only"
        return [missing(name, "%", rule, reason) for name in names]
    mean = (front + back) / 2
    middle = sum(rules.chord_range) / 2
    after = int(np.argmax(mean >= middle))
    last_front, last_back = (
        value_at_peak(branch.to_peak, column) for column in ("strain_axial", "strain_axial_back")
    )
    rows = []
    if mean[after] >= middle:
        at_middle = f"{rule} at strain {middle:g}"
        rows.append(_bending(names[0], float(front[after]), float(back[after]), at_middle, rules))
    else:
        rows.append(missing(names[0], "%", rule, f"the curve ends before strain {middle:g}"))
    if evidence.not_seen:
        return [*rows, missing(names[1], "%", f"{rule} at failure", evidence.not_seen)]
    return [*rows, _bending(names[1], last_front, last_back, f"{rule} at failure", rules)]


def _bending(name: str, front: float, back: float, rule: str, rules: AstmD6641) -> Property:
    if not front + back > 0:
        return missing(name, "%", rule, "no compressive strain recorded there")
    value = 100.0 * (front - back) / (front + back)
    limit = rules.bending_limit_percent
    flags = (f"bending {value:.3g} % beyond {limit:g} %",) if abs(value) > limit else ()
    return Property(name, value, "%", rule, points=1, flags=flags)


def _bending_remarks(flags: list[str]) -> list[str]:
    """Say on the other rows what the bending rows found."""
    start = "not assessed: "
    return [
        f"{flag.removeprefix(start)} (bending not assessed)" if flag.startswith(start) else flag
        for flag in flags
    ]
