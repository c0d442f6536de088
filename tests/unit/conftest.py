import importlib.util
import sys
from pathlib import Path

import pytest

from nptcs.tables.laboratory.material_card import PUBLISHED_PLY


@pytest.fixture(scope="session")
def published_ply():
    """Table 2 of the paper."""
    return dict(PUBLISHED_PLY)


@pytest.fixture
def ply(published_ply):
    """Give a copy that a test may change."""
    return dict(published_ply)


def load(name):
    path = Path(__file__).parent / "decks" / f"{name}.py"
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
def references():
    """What a deck, as read, uses and does not define."""
    return load("abaqus_references")


@pytest.fixture(scope="session")
def spoke_solver():
    """The tests' own solver for one spoke of a deck; benchmarks read the same file."""
    return load("abaqus_spoke")
