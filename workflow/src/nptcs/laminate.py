"""Classical lamination theory of the plates: plies [+A/-A] of equal thickness."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from nptcs.arrays import Array


def reduced_stiffness(ply: Mapping[str, float | Array]) -> Array:
    """Plane-stress stiffness Q of a ply in its fibre axes, MPa.

    Shape (3, 3); (m, 3, 3) if a constant has m values.
    """
    e1, e2, nu12, g12 = np.broadcast_arrays(
        *(np.asarray(ply[name], dtype=float) for name in ("e1_mpa", "e2_mpa", "nu12", "g12_mpa"))
    )
    scale = 1.0 / (1.0 - nu12**2 * e2 / e1)
    stiffness = np.zeros((*e1.shape, 3, 3))
    stiffness[..., 0, 0] = scale * e1
    stiffness[..., 0, 1] = stiffness[..., 1, 0] = scale * nu12 * e2
    stiffness[..., 1, 1] = scale * e2
    stiffness[..., 2, 2] = g12
    return stiffness


def rotated_stiffness(ply: Mapping[str, float | Array], angle_deg: float | Array) -> Array:
    """Plane-stress stiffness Q̄ with the fibres at an angle from the plate's axis, MPa.

    Shape (3, 3) for one angle, (m, 3, 3) for m angles.

    Examples
    --------
    Across the fibres, the stiffness E2/(1 - ν12 ν21):

    >>> from nptcs.tables.laboratory.material_card import PUBLISHED_PLY
    >>> rotated_stiffness(PUBLISHED_PLY, 90)[0, 0].round(0).item()
    8878.0
    """
    c, s = np.cos(np.radians(angle_deg)), np.sin(np.radians(angle_deg))
    # strains of the plate's axes to those of the fibre, engineering shear
    rows = np.array(
        [[c * c, s * s, c * s], [s * s, c * c, -c * s], [-2 * c * s, 2 * c * s, c * c - s * s]]
    )
    turn = np.moveaxis(rows, (0, 1), (-2, -1))
    return np.swapaxes(turn, -1, -2) @ reduced_stiffness(ply) @ turn


def transverse_shear(ply: Mapping[str, float], angle_deg: float) -> Array:
    """Transverse shear stiffness (2, 2) of components 13 and 23 in the plate's axes, MPa."""
    c, s = np.cos(np.radians(angle_deg)), np.sin(np.radians(angle_deg))
    turn = np.array([[c, s], [-s, c]])
    return turn.T @ np.diag([ply["g13_mpa"], ply["g23_mpa"]]) @ turn


def abd(
    ply: Mapping[str, float | Array], angle_deg: float | Array, thickness_mm: float | Array
) -> Array:
    """Laminate stiffness [[A, B], [B, D]] of [+A/-A]; the ply +A lies at z < 0.

    Shape (6, 6) for one plate, (m, 6, 6) for m angles and thicknesses. A in N/mm, B in N, D in
    N mm; strains and curvatures in the order 11, 22, 12.

    Examples
    --------
    Fibres along the plate: no coupling, and D11 = Q11 t³/12:

    >>> from nptcs.tables.laboratory.material_card import PUBLISHED_PLY
    >>> stiffness = abd(PUBLISHED_PLY, angle_deg=0, thickness_mm=1.2)
    >>> bool(np.allclose(stiffness[:3, 3:], 0))
    True
    >>> round(float(stiffness[3, 3] / reduced_stiffness(PUBLISHED_PLY)[0, 0] / 1.2**3 * 12), 6)
    1.0
    """
    half = np.asarray(thickness_mm)[..., None, None] / 2.0
    below = rotated_stiffness(ply, angle_deg)
    above = rotated_stiffness(ply, -np.asarray(angle_deg))
    membrane = (below + above) * half
    coupling = (above - below) * half**2 / 2.0
    bending = (below + above) * half**3 / 3.0
    return np.block([[membrane, coupling], [coupling, bending]])
