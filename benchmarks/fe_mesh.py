"""Errors of the meshes and of the energy table: the default ones against finer ones.

    python benchmarks/fe_mesh.py

Prints the spoke's stiffness (section 4.3.1) on several meshes with the difference from the finest,
for designs that span tables 5 and 7; then the tyre's stiffness with finer tables and finer rings.
The finest spoke mesh takes minutes; `--designs 1` runs only table 7's softest design.
"""

from __future__ import annotations

import argparse
import time

from nptcs.config.solvers.fe import EnergyTableOptions, FeModel, SpokeMesh, TyreMesh
from nptcs.config.solvers.tyre import TyreGeometry
from nptcs.fe.case import energy_table, loaded_tyre, spoke_design, tyre_model
from nptcs.fe.spoke.energy_table import SpokeEnergyTable
from nptcs.fe.spoke.equilibrium import SpokeModel
from nptcs.fe.spoke.period import SpokeDesign
from nptcs.fe.spoke.pull import spoke_stiffness
from nptcs.tables.laboratory.material_card import PUBLISHED_PLY

TYRE = TyreGeometry()
NAMES = ("spacing_mm", "thickness_mm", "angle_deg", "spoke_c10_mpa")
DESIGNS = (
    (15.0, 1.8, 45.0, 1.0),
    (15.0, 1.8, 45.0, 5.0),
    (20.0, 1.2, 90.0, 1.04),
    (10.0, 2.4, 0.0, 1.04),
)
SPOKE_MESHES = {
    "coarse": SpokeMesh(rows=(1, 1, 3, 1, 1, 1), gap_columns=1),
    "campaign": SpokeMesh(),
    "fine": SpokeMesh(rows=(2, 2, 6, 2, 2, 2), columns=2, plate_columns=1, gap_columns=2),
    "finest": SpokeMesh(rows=(3, 3, 9, 3, 3, 3), columns=3, plate_columns=2, gap_columns=3),
}
TABLES = {
    "campaign": EnergyTableOptions(),
    "more states": EnergyTableOptions(samples=(12, 3, 3), degrees=(16, 5)),
    "finest": EnergyTableOptions(samples=(12, 5, 5), degrees=(16, 8)),
}
RINGS = {
    "campaign": TyreMesh(),
    "twice along": TyreMesh(foot_elements=2, gap_elements=2),
    "twice through": TyreMesh(cover_rows=2, band_rows=2, tread_rows=2, wire_row_mm=0.025),
    "twice all": TyreMesh(
        foot_elements=2,
        gap_elements=2,
        cover_rows=2,
        band_rows=2,
        tread_rows=2,
        wire_row_mm=0.025,
    ),
    "thrice along": TyreMesh(foot_elements=3, gap_elements=3),
    "half a pitch on": TyreMesh(first_spoke_deg=3.0),
}


def design_of(model: FeModel, values: tuple[float, ...]) -> SpokeDesign:
    """Spoke of one design of the published ply."""
    return spoke_design(model, TYRE, PUBLISHED_PLY, dict(zip(NAMES, values, strict=True)))


def label(values: tuple[float, ...]) -> str:
    """Short name of a design."""
    return "S {:g} T {:g} A {:g} C10 {:g}".format(*values)


def spokes(count: int) -> None:
    """Tension and compression stiffness on each mesh, the finest first."""
    for values in DESIGNS[:count]:
        finest: tuple[float, float] | None = None
        for name in reversed(SPOKE_MESHES):
            start = time.process_time()
            model = FeModel(spoke_mesh=SPOKE_MESHES[name])
            spoke = SpokeModel(design_of(model, values))
            found = spoke_stiffness(spoke, 4, 5)
            pair = found.tension_fit.slope, found.compression_fit.slope
            finest = finest or pair
            errors = [100.0 * (a / b - 1.0) for a, b in zip(pair, finest, strict=True)]
            print(
                f"{label(values)}: {name}: {3 * len(spoke.mesh.positions)} unknowns, "
                f"k_t {pair[0]:.2f} ({errors[0]:+.2f} %), k_c {pair[1]:.2f} ({errors[1]:+.2f} %), "
                f"{time.process_time() - start:.1f} s",
                flush=True,
            )


def stiffness(model: FeModel, table: SpokeEnergyTable) -> float:
    """Secant stiffness of the tyre at 5000 N with a band of C10 5, N/mm."""
    return 5000.0 / loaded_tyre(tyre_model(model, TYRE, table, 5.0), model, 5000.0).rise_mm


def tyres(count: int) -> None:
    """Stiffness with each table, the finest first, then on each ring with the campaign's table."""
    for values in DESIGNS[:count]:
        finest: float | None = None
        for name in reversed(TABLES):
            model = FeModel(table=TABLES[name])
            table = energy_table(model, design_of(model, values))
            found = stiffness(model, table)
            finest = finest or found
            print(
                f"{label(values)}: table {name}: K {found:.2f} ({100 * (found / finest - 1):+.2f} "
                f"%), misfit of the force {table.force_residual_n:.2f} N",
                flush=True,
            )
        for name, ring in list(RINGS.items())[1:]:
            on_ring = stiffness(FeModel(tyre_mesh=ring), table)
            print(
                f"{label(values)}: ring {name}: K {on_ring:.2f} ({100 * (found / on_ring - 1):+.2f}"
                " % is the campaign's difference from it)",
                flush=True,
            )


def main() -> None:
    """Run the parts."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--designs", type=int, default=len(DESIGNS), help="how many of the four")
    arguments = parser.parse_args()
    spokes(arguments.designs)
    tyres(arguments.designs)


if __name__ == "__main__":
    main()
