"""An invented spoke whose energy is a formula, so that no finite element spoke is computed."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.stats import qmc

from nptcs.config.solvers.fe import EnergyTableOptions, SpokeGeometry
from nptcs.fe.spoke.energy_table import SpokeSamples, chebyshev_nodes, fit_energy

HEIGHT_MM = 84.1
OPTIONS = EnergyTableOptions(samples=(7, 3, 3), degrees=(8, 4))


def invented_table(scale=1.0, lean=6.0):
    """E = scale (6 s² - s³/20 + 9000 β² + 4000 φ² + lean 10 s φ + 60 s β²), N mm.

    Soft in compression as the real spokes; `lean` is the '<' spoke's preference of one side.
    """
    grid = [
        chebyshev_nodes(*limits, count)
        for limits, count in (((-40.0, 8.0), 7), ((0.0, 0.2), 3), ((-0.15, 0.15), 3))
    ]
    s, b, p = (part.ravel() for part in np.meshgrid(*grid, indexing="ij"))
    k = 10.0 * lean
    zero, one = 0.0 * s, 1.0 + 0.0 * s
    energy = 6 * s**2 - s**3 / 20 + 9000 * b**2 + 4000 * p**2 + k * s * p + 60 * s * b**2
    force = [12 * s - 0.15 * s**2 + k * p + 60 * b**2, 18000 * b + 120 * s * b, 8000 * p + k * s]
    tangent = [
        [12 - 0.3 * s, 120 * b, k * one],
        [120 * b, 18000 + 120 * s, zero],
        [k * one, zero, 8000 * one],
    ]
    samples = SpokeSamples(
        np.stack([s, b, p], axis=1),
        scale * energy,
        scale * np.stack(force, axis=1),
        scale * np.moveaxis(np.array(tangent), 2, 0),
    )
    return fit_energy(samples, OPTIONS, SpokeGeometry(height_mm=HEIGHT_MM))


@pytest.fixture(scope="session")
def table():
    """The invented spoke."""
    return invented_table()


@pytest.fixture(scope="session")
def even_table():
    """The same without a preferred side."""
    return invented_table(lean=0.0)


@pytest.fixture(scope="session")
def law():
    """Invented spokes of other designs: rubber, and plates that stiffen one shape of the energy."""

    def of(design, table):
        plates, thickness, angle, c10 = design
        share = plates * thickness**1.5 * (2.0 + np.cos(np.radians(2 * angle))) / 40.0
        side = np.where(table.exponents[:, 1] + table.exponents[:, 2] > 0, share, 0.3 * share)
        return replace(table, coefficients=table.coefficients * (c10 + c10**0.4 * side))

    return of


@pytest.fixture(scope="session")
def designs():
    """64 designs, spread over 11 to 22 plates, T, A and C10."""
    points = qmc.Sobol(4, seed=2).random(64)
    low, high = np.array([11, 1.2, 0, 1.0]), np.array([22, 2.4, 90, 5.0])
    found = low + points * (high - low)
    found[:, 0] = np.round(found[:, 0])
    return found
