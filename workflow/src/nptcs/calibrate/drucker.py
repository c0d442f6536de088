"""Drucker stability of a hyperelastic model over a range of strain, in every simple mode."""

from __future__ import annotations

import numpy as np

from nptcs.arrays import Array
from nptcs.calibrate.fit import HyperelasticModel
from nptcs.calibrate.invariants import stretches

# compression in a mode is the same path run backwards from λ = 1
PATHS = {
    "uniaxial": "rubber_tension",
    "equibiaxial": "rubber_equibiaxial",
    "pure shear": "rubber_pure_shear",
}
STEPS = 400


def instabilities(model: HyperelasticModel, constants: Array, largest_strain: float) -> list[str]:
    """Where the model is unstable, in words; empty if it is stable.

    Drucker's condition dτ : dε > 0 for an incompressible material: the Hessian of the energy in
    the logarithmic strains e1, e2 (e3 = -e1 - e2) is positive definite. Checked on uniaxial,
    equibiaxial and pure shear paths in tension from λ = 1 to 1 + `largest_strain` and in
    compression to its reciprocal.

    Parameters
    ----------
    model : HyperelasticModel
        The model.
    constants : ndarray, shape (k,)
        Its constants.
    largest_strain : float
        Upper end of the nominal strain range.

    Examples
    --------
    A Mooney–Rivlin rubber with a negative C01 softens in equibiaxial tension:

    >>> from nptcs.calibrate.invariants import MOONEY_RIVLIN, NEO_HOOKEAN
    >>> instabilities(NEO_HOOKEAN, np.array([1.18]), 1.0)
    []
    >>> instabilities(MOONEY_RIVLIN, np.array([1.0, -0.2]), 1.0)
    ['equibiaxial tension from strain 0.642', 'equibiaxial compression from strain -0.332']
    """
    found = []
    for words, mode in PATHS.items():
        for path, end in (
            (f"{words} tension", 1 + largest_strain),
            (f"{words} compression", 1 / (1 + largest_strain)),
        ):
            stretch = np.linspace(1.0, end, STEPS)
            l1, l2, _ = stretches(mode, stretch)
            lowest = np.linalg.eigvalsh(model.tangent(l1, l2, constants))[..., 0]
            if (lowest <= 0).any():
                first = stretch[int(np.argmax(lowest <= 0))] - 1
                found.append(f"{path} from strain {first:.3g}")
    return found
