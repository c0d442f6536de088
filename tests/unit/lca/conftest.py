import importlib.util
import sys
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from nptcs import lca
from nptcs.config.solvers.tyre import TyreGeometry

PUBLISHED = Path(__file__).resolve().parents[3] / "raw_data" / "published"


@pytest.fixture
def tyre():
    return TyreGeometry()


@pytest.fixture
def section(tyre):
    return lca.RingSection.from_tyre(tyre, 5.0)


@pytest.fixture
def spokes():
    return lca.LinearSpokes(30.2, 13.26)


@pytest.fixture(scope="session")
def published():
    files = {
        "table_7": "table7_rubber_doe.csv",
        "table_10": "table10_spoke_stiffness.csv",
        "table_11": "table11_lca_validation.csv",
        "load_errors": "figure15_load_errors.csv",
    }
    return {name: pd.read_csv(PUBLISHED / file) for name, file in files.items()}


def sweep_designs(rows: int, seed: int) -> tuple[dict[str, np.ndarray], np.ndarray]:
    """The range that the model is to hold over, log-uniform, with loads in N."""
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


@pytest.fixture(scope="session")
def sweep():
    return sweep_designs


@pytest.fixture(scope="session")
def independent():
    """The model written out for solve_bvp; benchmarks read the same file."""
    path = Path(__file__).with_name("independent.py")
    spec = importlib.util.spec_from_file_location("lca_independent", path)
    module = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = module
    spec.loader.exec_module(module)
    return module


@pytest.fixture(scope="session")
def design_of_row():
    return _design_of_row


def _design_of_row(designs, row):
    """Section and spokes of one row of a table of designs."""
    names = ("axial_stiffness_n", "shear_stiffness_n", "bending_stiffness_n_mm2")
    section = lca.RingSection(
        *(float(designs[name][row]) for name in (*names, "radius_mm", "width_mm"))
    )
    spokes = lca.LinearSpokes(
        float(designs["tension_n_per_mm"][row]), float(designs["compression_n_per_mm"][row])
    )
    return section, spokes
