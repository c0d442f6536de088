"""Designs over the range that the load-bearing model is meant for; a benchmark draws the same."""

import numpy as np


def sweep_designs(rows: int, seed: int) -> tuple[dict[str, np.ndarray], np.ndarray]:
    """Draw designs over the model's range, log-uniform, and loads in N."""
    random = np.random.default_rng(seed)

    def between(low, high):
        return np.exp(random.uniform(np.log(low), np.log(high), rows))

    c10, radius = between(0.5, 20), between(100, 1000)
    area = 215.0 * 14.0
    designs = {
        "axial_stiffness_n": 2.7018e7 + 6 * c10 * area,
        "shear_stiffness_n": 2 * c10 * area,
        "bending_stiffness_n_mm2": np.full(rows, 1.0554e9),
        "radius_mm": radius,
        "width_mm": np.full(rows, 215.0),
        "tension_n_per_mm": between(1, 1000),
        "compression_n_per_mm": between(1, 1000),
        "spoke_count": np.full(rows, 60.0),
    }
    return designs, between(100, 20000)
