"""The spoke of the Abaqus deck against fe_spoke, for small motions at rest.

    python benchmarks/abaqus_spoke.py
    python benchmarks/abaqus_spoke.py --angles

The deck is read back and solved by the solver of its tests (``tests/unit/decks/abaqus_spoke.py``):
constant-pressure bricks, embedded shear-flexible laminates. Radial stiffness of a whole spoke.
`--angles` gives the steps from angle to angle with bricks as wide as a plate and half as wide,
next to those of fe_spoke with embedded and with conforming plates, and table 5's.
"""

from __future__ import annotations

import argparse
import importlib.util
import sys
from collections.abc import Callable
from functools import partial
from pathlib import Path
from types import ModuleType

import numpy as np
import pandas as pd

from nptcs.config.solvers.abaqus import AbaqusMesh, AbaqusModel
from nptcs.config.solvers.fe import FeModel, PlateCoupling
from nptcs.config.solvers.tyre import TyreGeometry
from nptcs.decks.abaqus.deck import tyre_deck
from nptcs.fe.case import spoke_design
from nptcs.fe.spoke.equilibrium import SpokeModel
from nptcs.tables.laboratory.material_card import PUBLISHED_PLY

TESTS = Path(__file__).parents[1] / "tests" / "unit" / "decks"
PUBLISHED = Path(__file__).parents[1] / "raw_data" / "published" / "table5_plate_doe.csv"
ANGLES = (45.0, 60.0, 75.0, 90.0)
DESIGNS = ((15.0, 1.8, 45.0, 1.0), (15.0, 1.8, 45.0, 5.0), (10.0, 2.4, 0.0, 1.0),
           (20.0, 1.2, 90.0, 1.0))  # fmt: skip
SMALL_BAND = {"around": 60, "band_axial": 1}
MESHES = {
    "default": AbaqusMesh(**SMALL_BAND),
    "plates across the edges of bricks": AbaqusMesh(spoke_axial=22, **SMALL_BAND),
}


def load(name: str) -> ModuleType:
    """Import a file of the tests."""
    spec = importlib.util.spec_from_file_location(name, TESTS / f"{name}.py")
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    sys.modules[name] = module
    spec.loader.exec_module(module)
    return module


def spoke_values(spacing: float, thickness: float, angle: float, c10: float) -> dict[str, float]:
    """Return the values of a case."""
    return {
        "spacing_mm": spacing,
        "thickness_mm": thickness,
        "angle_deg": angle,
        "spoke_c10_mpa": c10,
        "shear_band_c10_mpa": 5.0,
    }


def deck_stiffness(mesh: AbaqusMesh, values: dict[str, float]) -> float:
    """Return the radial stiffness of a deck's spoke, N/mm."""
    reader, solver = load("abaqus_deck"), load("abaqus_spoke")
    text = tyre_deck(AbaqusModel(mesh=mesh), TyreGeometry(), PUBLISHED_PLY, values, 5000.0, "spoke")
    return float(solver.radial_stiffness(reader.read_deck(text), reader))


def own_stiffness(coupling: PlateCoupling, values: dict[str, float]) -> float:
    """Return the radial stiffness by `fe_spoke`, N/mm."""
    model = FeModel(plate_coupling=coupling)
    design = spoke_design(model, TyreGeometry(), PUBLISHED_PLY, values)
    return float(SpokeModel(design).rest().tangent[0, 0])


def stiffness() -> None:
    """Print both stiffnesses and their ratio."""
    for design in DESIGNS:
        values = spoke_values(*design)
        ours = own_stiffness("embedded", values)
        for name, mesh in MESHES.items():
            theirs = deck_stiffness(mesh, values)
            print(
                "S {:g} T {:g} A {:g} C10 {:g}: ".format(*design)
                + f"fe_spoke {ours:.2f} N/mm, deck ({name}) {theirs:.2f} N/mm, "
                f"{theirs / ours - 1:+.1%}",
                flush=True,
            )


def angle_steps() -> None:
    """Print 0.53 times the change of the spoke's log stiffness, an estimate of the tyre's."""
    fine = AbaqusMesh(spoke_axial=86, plate=(11, 4), **SMALL_BAND)
    solvers: dict[str, Callable[[dict[str, float]], float]] = {
        "deck, bricks as wide as a plate": partial(deck_stiffness, MESHES["default"]),
        "fe_spoke, embedded": partial(own_stiffness, "embedded"),
        "deck, bricks half as wide": partial(deck_stiffness, fine),
        "fe_spoke, conforming": partial(own_stiffness, "conforming"),
    }
    published = pd.read_csv(PUBLISHED, comment="#").set_index(
        ["spacing_mm", "thickness_mm", "angle_deg"]
    )["stiffness_n_per_mm"]
    for thickness in (1.2, 1.8):
        tyres = [published[15.0, thickness, angle] for angle in ANGLES]
        print(f"T {thickness:g}: table 5: {percent(tyres, 1.0)}", flush=True)
        for name, solve in solvers.items():
            found = [solve(spoke_values(15.0, thickness, angle, 1.04)) for angle in ANGLES]
            print(f"T {thickness:g}: {name}: {percent(found, 0.53)}", flush=True)


def percent(stiffness_n_per_mm: list[float], power: float) -> str:
    """Format the steps of the log stiffness, in per cent."""
    steps = 100.0 * power * np.diff(np.log(stiffness_n_per_mm))
    pairs = zip(ANGLES[:-1], ANGLES[1:], steps, strict=True)
    return ", ".join(f"{low:g} to {high:g} deg {step:+.2f} %" for low, high, step in pairs)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--angles", action="store_true")
    if parser.parse_args().angles:
        angle_steps()
    else:
        stiffness()
