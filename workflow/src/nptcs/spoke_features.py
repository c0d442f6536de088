"""The variables that a spoke's energy depends on smoothly.

A spoke's energy divided by its rubber's C10 depends on the number of its plates and on their
stiffness divided by C10. For the laminate [+A/-A] that stiffness is T E(A) in stretch and T³ E(A)
in bending; the process takes both as logarithms, in addition to the four design variables. The
number of plates and the thickness enter as powers, and so are taken as logarithms, too.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from nptcs.arrays import Array
from nptcs.laminate import rotated_stiffness


def spoke_features(designs: Array, ply: Mapping[str, float]) -> Array:
    """Features (n, 6) of spokes.

    Parameters
    ----------
    designs : array (n, 4)
        Number of plates, thickness T (mm), fibre angle A (degrees), C10 of the spoke (MPa).
    ply : mapping
        ``e1_mpa``, ``e2_mpa``, ``nu12``, ``g12_mpa`` of the ply.

    Returns
    -------
    array (n, 6)
        Log plates, log T, A, log C10, log(T³ E_free/C10) with the modulus of the ply that may
        contract and shear, log(T E_held/C10) with that of the ply that may not (lamination
        theory: 1/S̄11 and Q̄11).
    """
    plates, thickness, angle, c10 = designs.T
    stiffness = np.array([rotated_stiffness(ply, degrees) for degrees in angle])
    held, free = stiffness[:, 0, 0], 1.0 / np.linalg.inv(stiffness)[:, 0, 0]
    return np.stack(
        [
            np.log(plates),
            np.log(thickness),
            angle,
            np.log(c10),
            np.log(thickness**3 * free / c10),
            np.log(thickness * held / c10),
        ],
        axis=1,
    )
