"""Checks of the nine constants of an orthotropic ply."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import pandas as pd

from nptcs.arrays import Array
from nptcs.errors import InputError
from nptcs.tables.laboratory.material_card import CardConstant

# a normal variable is further out once in 370 times
LARGEST_DISTANCE = 3.0


def compliance_matrix(values: Mapping[str, float]) -> Array:
    """Compliance of an orthotropic material, 6 × 6, 1/MPa, order 11 22 33 23 13 12.

    S_ij = -ν_ij/E_i off the diagonal of the normal block, with ν_ji/E_j = ν_ij/E_i; shear
    strains are engineering strains.

    Parameters
    ----------
    values : mapping of str to float
        `nptcs.tables.laboratory.material_card.PLY_CONSTANTS`.

    Examples
    --------
    >>> from nptcs.tables.laboratory.material_card import PUBLISHED_PLY
    >>> matrix = compliance_matrix(PUBLISHED_PLY)
    >>> matrix.shape, round(1 / float(matrix[0, 0]), 6)
    ((6, 6), 128000.0)
    """
    e1, e2, e3 = (values[f"e{i}_mpa"] for i in (1, 2, 3))
    s12, s13, s23 = -values["nu12"] / e1, -values["nu13"] / e1, -values["nu23"] / e2
    matrix = np.zeros((6, 6))
    matrix[:3, :3] = [[1 / e1, s12, s13], [s12, 1 / e2, s23], [s13, s23, 1 / e3]]
    shear = [values["g23_mpa"], values["g13_mpa"], values["g12_mpa"]]
    matrix[3:, 3:] = np.diag(1 / np.array(shear))
    return matrix


def check_ply(values: Mapping[str, float], material: str, tolerance_percent: float) -> list[str]:
    """Check positive energy and say how far the ply is from transverse isotropy.

    Parameters
    ----------
    values : mapping of str to float
        The nine constants.
    material : str
        Name for messages.
    tolerance_percent : float
        Difference of G23 from E2/(2(1+ν23)) beyond which the ply is called not transversely
        isotropic. That is a remark: an orthotropic ply is a legitimate material.

    Returns
    -------
    list of str
        What was found, in words.

    Raises
    ------
    InputError
        If a modulus is not positive or the compliance is not positive definite: no material
        has such constants.

    Examples
    --------
    >>> from nptcs.tables.laboratory.material_card import PUBLISHED_PLY
    >>> for finding in check_ply(PUBLISHED_PLY, "cfrp", tolerance_percent=5):
    ...     print(finding)
    compliance matrix is positive definite
    warning: orthotropic, not transversely isotropic: G23 = 2300 MPa, E2/(2(1+nu23)) = 3259 MPa ...
    """
    for name, value in values.items():
        if name.endswith("_mpa") and not value > 0:
            raise InputError(
                f"material {material}: {name} must be positive",
                "check the curves and the source of this constant",
                column=name,
                value=value,
            )
    _require_positive_definite(values, material)
    return [
        "compliance matrix is positive definite",
        *_transverse_isotropy(values, tolerance_percent),
    ]


def check_reciprocity(measured: Mapping[str, CardConstant], nu21: pd.Series) -> str:
    """Compare ν12/E1 = ν21/E2 with ν21 as measured on 90° specimens, in words.

    Parameters
    ----------
    measured : mapping of str to CardConstant
        e1_mpa, e2_mpa and nu12 with their standard errors.
    nu21 : Series
        Poisson's ratios of the 90° specimens; may be empty.
    """
    e1, e2, nu12 = (measured[name] for name in ("e1_mpa", "e2_mpa", "nu12"))
    expected = nu12.value * e2.value / e1.value
    words = f"reciprocity nu12/E1 = nu21/E2 sets nu21 = {expected:.4g}"
    if nu21.empty:
        return f"{words}; nu21 was not measured"
    found = f"measured {nu21.mean():.4g} on {len(nu21)} specimens"
    errors = [q.standard_error for q in (e1, e2, nu12)]
    if len(nu21) < 2 or None in errors:
        return f"{words}; {found} (no standard error to judge the difference by)"
    relative = [(q.standard_error or 0.0) / q.value for q in (e1, e2, nu12)]
    own = float(nu21.std(ddof=1)) / np.sqrt(len(nu21))
    distance = (nu21.mean() - expected) / np.hypot(own, expected * np.linalg.norm(relative))
    verdict = "agrees" if abs(distance) <= LARGEST_DISTANCE else "warning: does not agree"
    return f"{words}; {found}: {verdict} ({distance:+.1f} standard errors)"


def _require_positive_definite(values: Mapping[str, float], material: str) -> None:
    # scaled by √(S_ii S_jj): eigenvalues of order one whatever the units
    matrix = compliance_matrix(values)
    scale = 1 / np.sqrt(np.diag(matrix))
    lowest = float(np.linalg.eigvalsh(matrix * np.outer(scale, scale)).min())
    if lowest <= 1e-12:
        raise InputError(
            f"material {material}: the compliance matrix is not positive definite "
            f"(lowest scaled eigenvalue {lowest:.3g}), Poisson's ratios "
            f"nu12 {values['nu12']:.4g}, nu13 {values['nu13']:.4g}, nu23 {values['nu23']:.4g}",
            "check the transverse strains and the assumed Poisson's ratios: "
            "|nu12| < sqrt(E1/E2), and likewise for nu13 and nu23",
            column="nu12, nu13, nu23",
        )


def _transverse_isotropy(values: Mapping[str, float], tolerance_percent: float) -> list[str]:
    isotropic = values["e2_mpa"] / (2 * (1 + values["nu23"]))
    difference = 100 * (values["g23_mpa"] / isotropic - 1)
    pairs = (("e2_mpa", "e3_mpa"), ("nu12", "nu13"), ("g12_mpa", "g13_mpa"))
    unequal = [f"{a} is not {b}" for a, b in pairs if not np.isclose(values[a], values[b])]
    words = f"G23 = {values['g23_mpa']:.4g} MPa, E2/(2(1+nu23)) = {isotropic:.4g} MPa"
    if unequal or abs(difference) > tolerance_percent:
        detail = "; ".join([f"{words} ({difference:+.1f} %)", *unequal])
        return [f"warning: orthotropic, not transversely isotropic: {detail}"]
    return [f"transversely isotropic within {tolerance_percent:g} %: {words}"]
