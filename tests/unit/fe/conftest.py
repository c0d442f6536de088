import numpy as np
import pytest

from nptcs.fe.spoke.energy_table import SpokeEnergyTable


@pytest.fixture(scope="session")
def springs():
    """Springs in place of a spoke."""
    return spring_table


def spring_table(k_r=20.0, k_theta=1.0, k_phi=3000.0, low=-40.0, height=84.1):
    """Springs as a table: E = k_r s²/2 + k_θ (H β)²/2 + k_φ φ²/2, in Chebyshev terms.

    Springs have no legs that could straighten.
    """
    limits = np.array([[low, -low], [-0.3, 0.3], [-0.3, 0.3]])
    exponents, coefficients = [(0, 0, 0)], [0.0]
    for axis, k in enumerate((k_r, height**2 * k_theta, k_phi)):
        # x² = (T2 + 1)/2
        scale = 0.5 * k * limits[axis, 1] ** 2 / 2.0
        exponents.append(tuple(2 * int(i == axis) for i in range(3)))
        coefficients.append(scale)
        coefficients[0] += scale
    return SpokeEnergyTable(
        height,
        1e12,
        limits[:, 0],
        limits[:, 1],
        np.array(exponents),
        np.array(coefficients),
        1.0,
        0.0,
    )
