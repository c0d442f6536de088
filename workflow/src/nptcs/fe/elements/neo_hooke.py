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
    from nptcs.fe.elements import compiled

    inverse, values = np.empty(deformation.shape), np.empty((5, pressure.size))
    flat = np.ascontiguousarray(deformation).reshape(-1, 3, 3)
    places = inverse.reshape(-1, 3, 3)
    compiled.neo_hooke_at(c10_mpa, flat, np.ascontiguousarray(pressure).ravel(), places, values)
    volume, scale, third, pull, energy = values.reshape(5, *pressure.shape)
    if not np.all(volume > 0.0):
        raise FloatingPointError("an element of rubber has turned inside out")
    return NeoHooke(volume, inverse, scale, third, pull, energy)
