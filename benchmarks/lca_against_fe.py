"""The load-bearing model with linear and with nonlinear spokes, against our finite elements.

    python benchmarks/lca_against_fe.py [--spoke-c10 1 3 5] [--loads 1500 3000 4000 5000 6000]

For each spoke rubber, finite elements pull and press one spoke (the model of `fe_spoke`) and load
the whole tyre (`fe_tyre`). The ring is then solved twice with the same spoke: with two straight
lines fitted as in section 4.3.1, as in the paper, and with the spoke's own curve.
Prints the tyre's displacement and the errors of both. T-C = 5 MPa, plates at the fiducial values,
table 2's ply.
"""

from __future__ import annotations

import argparse

import numpy as np

from nptcs import lca
from nptcs.config.solvers.fe import FeModel
from nptcs.config.solvers.tyre import TyreGeometry
from nptcs.fe.case import energy_table, spoke_design, tyre_model
from nptcs.fe.spoke.equilibrium import SpokeModel
from nptcs.fe.spoke.pull import pull, spoke_stiffness
from nptcs.fe.tyre.equilibrium import TyreError
from nptcs.tables.laboratory.material_card import PUBLISHED_PLY

BAND_C10_MPA = 5.0
PLATES = {"spacing_mm": 15.0, "thickness_mm": 1.8, "angle_deg": 45.0}
REACH_MM = (8.0, 32.0)
"""How far the spoke is pulled and pressed for its curve."""


def compare(spoke_c10_mpa: float, loads_n: list[float]) -> None:
    """Print a row for each load."""
    model, tyre = FeModel(), TyreGeometry()
    design = spoke_design(model, tyre, PUBLISHED_PLY, {**PLATES, "spoke_c10_mpa": spoke_c10_mpa})
    spoke = SpokeModel(design)
    lines = spoke_stiffness(spoke, 16, 40)
    straight = lca.LinearSpokes(lines.tension_fit.slope, lines.compression_fit.slope)
    pulled, pressed = pull(spoke, REACH_MM[0], 32), pull(spoke, -REACH_MM[1], 64)
    curved = lca.SpokeLaw.from_curves(*pulled, *pressed)
    section = lca.ShearBandSection.from_tyre(tyre, BAND_C10_MPA)
    loaded = tyre_model(model, tyre, energy_table(model, design), BAND_C10_MPA)
    try:
        path = loaded.load(loads_n).path
    except TyreError as error:
        print(f"{spoke_c10_mpa:4g} finite elements: {error}", flush=True)
        path = error.path
    for load in loads_n:
        reached = np.flatnonzero(np.isclose(path.force_n, load))
        if not len(reached):
            continue
        fe = path.rise_mm[int(reached[-1])]
        line = lca.solve(section, straight, load_n=load).displacement_mm
        paper = lca.solve_law(section, curved, load_n=load, contact="paper").displacement_mm
        local = lca.solve_law(section, curved, load_n=load, contact="local").displacement_mm
        print(
            f"{spoke_c10_mpa:4g} {load:6g}  {fe:8.3f} {line:8.3f} {paper:8.3f} {local:8.3f}  "
            f"{100 * (line / fe - 1):+6.2f} {100 * (paper / fe - 1):+6.2f} "
            f"{100 * (local / fe - 1):+6.2f}",
            flush=True,
        )


def main() -> None:
    """Read the arguments and print the table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--spoke-c10", type=float, nargs="+", default=[1.0, 3.0, 5.0])
    parser.add_argument("--loads", type=float, nargs="+", default=[1500, 3000, 4000, 5000, 6000])
    arguments = parser.parse_args()
    print("S-C  load N   FE mm   lines mm curve,δ  curve    errors %: lines, curve with δ, curve")
    for c10 in arguments.spoke_c10:
        compare(c10, sorted(arguments.loads))


if __name__ == "__main__":
    main()
