"""Stress and strain of the example specimens, without noise."""

from __future__ import annotations

import numpy as np

from nptcs.arrays import Array

SHEAR_LINEAR_LIMIT = 0.008
"""Shear strain up to which the ±45° laminate is linear; G12 is measured below (D3518)."""
SHEAR_PLATEAU_MPA = 62.0
POISSON_45 = 0.74
"""-ε_y / ε_x of a ±45° carbon laminate."""
YEOH_RATIOS = (-0.09, 0.02)
"""C20 / C10 and C30 / C10 of the example rubbers."""
FIT_RANGE = 0.15


def shear_stress(shear_strain: Array, g12_mpa: float) -> Array:
    """τ(γ) in MPa: linear with slope G12, then approaching a plateau with equal slope."""
    limit = g12_mpa * SHEAR_LINEAR_LIMIT
    room = SHEAR_PLATEAU_MPA - limit
    beyond = np.clip(shear_strain - SHEAR_LINEAR_LIMIT, 0, None)
    return g12_mpa * np.minimum(shear_strain, SHEAR_LINEAR_LIMIT) + room * (
        1 - np.exp(-g12_mpa * beyond / room)
    )


def yeoh_stress(strain: Array, c10_mpa: float) -> Array:
    """Nominal stress in MPa, P = 2(λ - λ⁻²) Σ i·C_i0 (I1 - 3)^(i-1), uniaxial."""
    stretch = 1 + strain
    invariant = stretch**2 + 2 / stretch - 3
    c20, c30 = (ratio * c10_mpa for ratio in YEOH_RATIOS)
    series = c10_mpa + 2 * c20 * invariant + 3 * c30 * invariant**2
    return 2 * (stretch - stretch**-2) * series


def yeoh_c10(neo_hookean_c10_mpa: float) -> float:
    """Yeoh C10 whose neo-Hookean fit over `FIT_RANGE` gives the requested value.

    The fit is the closed form C10 = Σ fP / Σ f², f = 2(λ - λ⁻²), over evenly spread strains;
    P is proportional to C10, so one division is enough.
    """
    strain = np.linspace(0, FIT_RANGE, 1001)
    shape = 2 * ((1 + strain) - (1 + strain) ** -2)
    fitted = float((shape * yeoh_stress(strain, 1.0)).sum() / (shape**2).sum())
    return neo_hookean_c10_mpa / fitted
