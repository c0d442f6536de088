"""Designs as coded points: space filling, central composite, Box–Behnken."""

from __future__ import annotations

from itertools import combinations, product

import numpy as np
from scipy.stats import qmc

from nptcs.arrays import Array
from nptcs.config.studies.design import AxialCases, SpaceFillingKind
from nptcs.errors import InputError

BOX_BEHNKEN_FACTORS = (3, 4, 5)
"""Numbers of factors for which the design consists of all pairs; more need incomplete blocks."""


def space_filling(kind: SpaceFillingKind, cases: int, factors: int, seed: int) -> Array:
    """Spread cases over the box, shape (cases, factors).

    A Latin hypercube is evened out by random exchanges that lower its centred discrepancy. Of a
    scrambled Sobol sequence whose length is the next power of two, the first `cases` points are
    taken.
    """
    generator = np.random.default_rng(seed)
    if kind == "latin_hypercube":
        sampler = qmc.LatinHypercube(factors, optimization="random-cd", rng=generator)
        return 2 * sampler.random(cases) - 1
    sequence = qmc.Sobol(factors, rng=generator)
    return 2 * sequence.random_base2(int(np.ceil(np.log2(cases))))[:cases] - 1


def central_composite(factors: int, axial: AxialCases, centre_cases: int) -> Array:
    """Corners, axial points and centre, shape (2ⁿ + 2n + centre, n).

    With inscribed axial points the corners lie at 2^(-n/4), and the variance of a second-order
    surface depends only on the distance from the centre.
    """
    corner = 1.0 if axial == "face" else 2.0 ** (-factors / 4)
    corners = corner * np.array(list(product([-1.0, 1.0], repeat=factors)))
    axes = [side * unit for unit in np.eye(factors) for side in (-1.0, 1.0)]
    return np.vstack([corners, axes, np.zeros((centre_cases, factors))])


def box_behnken(factors: int, centre_cases: int) -> Array:
    """Combine the corners of each pair of factors, all others at their middle, with the centre.

    Raises
    ------
    InputError
        For fewer than three or more than five factors.
    """
    if factors not in BOX_BEHNKEN_FACTORS:
        raise InputError(
            "a Box–Behnken design needs three to five factors",
            column="design",
            value=factors,
            remedy="use central_composite or d_optimal",
        )
    points = []
    for pair in combinations(range(factors), 2):
        for sides in product([-1.0, 1.0], repeat=2):
            point = np.zeros(factors)
            point[list(pair)] = sides
            points.append(point)
    return np.vstack([*points, np.zeros((centre_cases, factors))])
