import pytest

from nptcs.config.solvers.abaqus import AbaqusMesh, AbaqusModel
from nptcs.config.solvers.tyre import TyreGeometry
from nptcs.decks.abaqus.deck import tyre_deck
from nptcs.tables.laboratory.material_card import PUBLISHED_PLY

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
def text():
    """The Abaqus deck of one case on the default mesh."""
    return tyre_deck(AbaqusModel(), TyreGeometry(), PUBLISHED_PLY, CASE, 5000.0, "c_001")


@pytest.fixture(scope="session")
def deck(text, reader):
    """That deck, read."""
    return reader.read_deck(text)


@pytest.fixture(scope="session")
def small_text():
    """The deck of that case on a small mesh."""
    return tyre_deck(AbaqusModel(mesh=SMALL), TyreGeometry(), PUBLISHED_PLY, CASE, 5000.0, "small")


@pytest.fixture
def small_deck(reader):
    """Read the deck of another case, by default on a small mesh."""

    def make(model=None, tyre=None, load_n=5000.0, **changes):
        model = AbaqusModel(mesh=SMALL) if model is None else model
        tyre = TyreGeometry() if tyre is None else tyre
        values = CASE | changes
        return reader.read_deck(tyre_deck(model, tyre, PUBLISHED_PLY, values, load_n, "small"))

    return make
