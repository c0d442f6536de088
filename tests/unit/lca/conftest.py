import importlib.util
import sys
from pathlib import Path

import pandas as pd
import pytest
from lca_designs import sweep_designs

from nptcs import lca
from nptcs.config.solvers.tyre import TyreGeometry

PUBLISHED = Path(__file__).resolve().parents[3] / "raw_data" / "published"


@pytest.fixture
def tyre():
    return TyreGeometry()


@pytest.fixture
def section(tyre):
    return lca.ShearBandSection.from_tyre(tyre, 5.0)


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
    section = lca.ShearBandSection(
        *(float(designs[name][row]) for name in (*names, "radius_mm", "width_mm"))
    )
    spokes = lca.LinearSpokes(
        float(designs["tension_n_per_mm"][row]), float(designs["compression_n_per_mm"][row])
    )
    return section, spokes
