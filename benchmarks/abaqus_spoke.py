"""The spoke of the Abaqus deck against fe_spoke, for small motions at rest.

    python benchmarks/abaqus_spoke.py

The deck is read back and solved by the solver of its tests (``tests/unit/fe/abaqus_spoke.py``):
constant-pressure bricks, embedded shear-flexible laminates. Radial stiffness of a whole spoke.
"""

from __future__ import annotations

import importlib.util
import sys
from pathlib import Path
from types import ModuleType

from nptcs.config.abaqus import AbaqusMesh, AbaqusModel
from nptcs.config.fe import FeModel
from nptcs.config.tyre import TyreGeometry
from nptcs.fe.abaqus import tyre_deck
from nptcs.fe.case import spoke_design
from nptcs.fe.spoke import SpokeModel
from nptcs.materials import PUBLISHED_PLY

TESTS = Path(__file__).parents[1] / "tests" / "unit" / "fe"
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


def main() -> None:
    """Print both stiffnesses and their ratio."""
    reader, solver = load("abaqus_deck"), load("abaqus_spoke")
    tyre = TyreGeometry()
    for spacing, thickness, angle, c10 in DESIGNS:
        values = {
            "spacing_mm": spacing,
            "thickness_mm": thickness,
            "angle_deg": angle,
            "spoke_c10_mpa": c10,
            "shear_band_c10_mpa": 5.0,
        }
        design = spoke_design(FeModel(), tyre, PUBLISHED_PLY, values)
        ours = SpokeModel(design).rest().tangent[0, 0]
        for name, mesh in MESHES.items():
            text = tyre_deck(AbaqusModel(mesh=mesh), tyre, PUBLISHED_PLY, values, 5000.0, "spoke")
            theirs = solver.radial_stiffness(reader.read_deck(text), reader)
            print(
                f"S {spacing:g} T {thickness:g} A {angle:g} C10 {c10:g}: fe_spoke {ours:.2f} N/mm, "
                f"deck ({name}) {theirs:.2f} N/mm, {theirs / ours - 1:+.1%}",
                flush=True,
            )


if __name__ == "__main__":
    main()
