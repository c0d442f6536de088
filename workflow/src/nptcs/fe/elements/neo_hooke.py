"""The neo-Hookean law of nearly incompressible rubber, equation 1 of the paper."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from nptcs.arrays import Array


@dataclass(frozen=True)
class NeoHooke:
    """The neo-Hookean law C10 (Ī1 - 3) + p (J - 1) at a set of points, with G = F⁻ᵀ.

    With a = 2 C10 J^(-2/3) stress and moduli are

        P = a F + (p J - a I1/3) G
        ∂P_iJ/∂F_jL = a [δ_ij δ_JL - 2/3 (F_iJ G_jL + G_iJ F_jL) + 2/9 I1 G_iJ G_jL]
                      + p J G_iJ G_jL + (a I1/3 - p J) G_iL G_jJ

    Parameters
    ----------
    volume : array (…)
        J.
    inverse : array (…, 3, 3)
        G.
    scale, third, pull : array (…)
        a, a I1/3 and p J, MPa.
    energy : array (…)
        C10 (Ī1 - 3), N mm per mm³.
    """

    volume: Array
    inverse: Array
    scale: Array
    third: Array
    pull: Array
    energy: Array


def neo_hookean(c10_mpa: float, deformation: Array, pressure: Array) -> NeoHooke:
    """Evaluate the law at deformation gradients F (…, 3, 3) and pressures p (…) in MPa.

    Raises
    ------
    FloatingPointError
        If a volume is not positive.
    """
    cofactor = cofactors(deformation)
    volume = np.sum(deformation[..., 0, :] * cofactor[..., 0, :], axis=-1)
    if not np.all(volume > 0.0):
        raise FloatingPointError("an element of rubber has turned inside out")
    trace = np.sum(deformation**2, axis=(-1, -2))
    unit = volume ** (-2.0 / 3.0)
    scale = 2.0 * c10_mpa * unit
    return NeoHooke(
        volume=volume,
        inverse=cofactor / volume[..., None, None],
        scale=scale,
        third=scale * trace / 3.0,
        pull=pressure * volume,
        energy=c10_mpa * (unit * trace - 3.0),
    )


def cofactors(matrix: Array) -> Array:
    """Cofactors of matrices (…, 3, 3): det M M⁻ᵀ."""
    found = np.empty_like(matrix)
    for i in range(3):
        above, below = matrix[..., (i + 1) % 3, :], matrix[..., (i + 2) % 3, :]
        for j in range(3):
            k, m = (j + 1) % 3, (j + 2) % 3
            found[..., i, j] = above[..., k] * below[..., m] - above[..., m] * below[..., k]
    return found
