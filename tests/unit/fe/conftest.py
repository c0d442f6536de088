import importlib.util
import sys
from pathlib import Path

import numpy as np
import pytest

from nptcs.config.abaqus import AbaqusMesh, AbaqusModel
from nptcs.config.tyre import TyreGeometry
from nptcs.decks.abaqus.deck import tyre_deck
from nptcs.fe.spoke.energy_table import SpokeEnergyTable
from nptcs.tables.material_card import PUBLISHED_PLY

CASE = {
    "spacing_mm": 15.0,
    "thickness_mm": 1.8,
    "angle_deg": 30.0,
    "spoke_c10_mpa": 3.0,
    "shear_band_c10_mpa": 5.0,
}
SMALL = AbaqusMesh(
    rows=(1, 1, 2, 1, 1, 1), columns=2, spoke_axial=7, plate=(3, 1), around=60, band_axial=3
)


@pytest.fixture(scope="session")
def published_ply():
    """Table 2 of the paper."""
    return dict(PUBLISHED_PLY)


@pytest.fixture
def ply(published_ply):
    """Give a copy that a test may change."""
    return dict(published_ply)


def load(name):
    path = Path(__file__).with_name(f"{name}.py")
    spec = importlib.util.spec_from_file_location(name, path)
    module = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = module
    spec.loader.exec_module(module)
    return module


@pytest.fixture(scope="session")
def reader():
    """The tests' own reader of Abaqus decks; benchmarks read the same file."""
    return load("abaqus_deck")


@pytest.fixture(scope="session")
def spoke_solver():
    """A solver of its own for one spoke of a deck; benchmarks read the same file."""
    return load("abaqus_spoke")


@pytest.fixture(scope="session")
def text():
    """The Abaqus deck of one case on the default mesh."""
    return tyre_deck(AbaqusModel(), TyreGeometry(), PUBLISHED_PLY, CASE, 5000.0, "c_001")


@pytest.fixture(scope="session")
def deck(text, reader):
    """That deck, read."""
    return reader.read_deck(text)


@pytest.fixture
def small_deck(reader):
    """Read the deck of another case, by default on a small mesh."""

    def make(model=None, tyre=None, load_n=5000.0, **changes):
        model = AbaqusModel(mesh=SMALL) if model is None else model
        tyre = TyreGeometry() if tyre is None else tyre
        values = CASE | changes
        return reader.read_deck(tyre_deck(model, tyre, PUBLISHED_PLY, values, load_n, "small"))

    return make


@pytest.fixture(scope="session")
def springs():
    """Springs in place of a spoke."""
    return spring_table


def spring_table(k_r=20.0, k_theta=1.0, k_phi=3000.0, low=-40.0, height=84.1):
    """Springs as a table: E = k_r s²/2 + k_θ (H β)²/2 + k_φ φ²/2, in Chebyshev terms."""
    limits = np.array([[low, -low], [-0.3, 0.3], [-0.3, 0.3]])
    exponents, coefficients = [(0, 0, 0)], [0.0]
    for axis, k in enumerate((k_r, height**2 * k_theta, k_phi)):
        # x² = (T2 + 1)/2
        scale = 0.5 * k * limits[axis, 1] ** 2 / 2.0
        exponents.append(tuple(2 * int(i == axis) for i in range(3)))
        coefficients.append(scale)
        coefficients[0] += scale
    return SpokeEnergyTable(
        height, limits[:, 0], limits[:, 1], np.array(exponents), np.array(coefficients), 1.0, 0.0
    )
