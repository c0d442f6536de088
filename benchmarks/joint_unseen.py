"""The joint study's surfaces at spokes that were never solved.

    python benchmarks/joint_unseen.py [--models results/6_surface/models/joint.json]
        [--card results/material_card.json] [--spokes results/5_solve/spokes] [--points 5] [--fe]

Takes points inside the box of the joint study (Latin hypercube, whole plates), computes their
spokes and solves them by `ring`, and with ``--fe`` by `fe_tyre` too. Prints the stiffness that each
load's surface predicts with its 95 % interval, the solver's value with the plies of the study's
card, and the difference in per cent. Run ``make joint`` first.
"""

from __future__ import annotations

import argparse
from collections.abc import Mapping
from pathlib import Path

import numpy as np
import pandas as pd

from nptcs.config.solvers.tyre import TyreGeometry
from nptcs.doe.points import space_filling
from nptcs.doe.whole_plates import whole_plates
from nptcs.files import read_model
from nptcs.responses.curve import LoadCurve
from nptcs.solvers import fe_tyre, ring
from nptcs.solvers.contract import CaseInputs, SolverResult, Status
from nptcs.surface.registry import SurfaceRegistry
from nptcs.surface.stored import read_registry
from nptcs.surface.study import RESPONSE
from nptcs.tables.laboratory.material_card import MaterialCard

TYRE = TyreGeometry()
LOAD_N = 5000.0


def unseen_points(registry: SurfaceRegistry, count: int) -> pd.DataFrame:
    """Points inside the box, spacings with a whole number of plates."""
    fitted = registry.find(RESPONSE)
    low, high = np.array(list(fitted.box().values())).T
    coded = space_filling("latin_hypercube", count, len(low), 20)
    points = (low + high) / 2 + coded * (high - low) / 2
    moved = whole_plates(points, list(fitted.factors), TYRE)
    return pd.DataFrame(moved, columns=list(fitted.factors))


def solved(
    values: dict[str, float], ply: Mapping[str, float], spokes: Path, finite: bool
) -> SolverResult:
    """Solve a point on its computed spoke."""
    if finite:
        options = fe_tyre.FeTyreOptions(spoke_cache=spokes, plate_stress="off")
        return fe_tyre.solve(CaseInputs("", values, LOAD_N, TYRE, options, ply=ply))
    own = ring.RingSolverOptions(spoke_cache=spokes)
    return ring.solve(CaseInputs("", values, LOAD_N, TYRE, own, ply=ply))


def report(
    registry: SurfaceRegistry,
    points: pd.DataFrame,
    ply: Mapping[str, float],
    spokes: Path,
    finite: bool,
) -> None:
    """Print each point and the largest difference by load."""
    loads = {
        response.load_n: registry.find(response)
        for response in registry.responses()
        if response.name == "secant_stiffness"
    } | {LOAD_N: registry.find(RESPONSE)}
    worst: dict[str, float] = {}
    for values in points.to_dict("records"):
        print(", ".join(f"{name} {value:.4g}" for name, value in values.items()))
        for name in ("ring", "fe_tyre") if finite else ("ring",):
            result = solved(values, ply, spokes, name == "fe_tyre")
            if result.status is not Status.OK or result.curve is None:
                print(f"  {name}: {result.status}: {result.message}")
                continue
            curve = LoadCurve(
                np.array(result.curve["displacement_mm"]), np.array(result.curve["force_n"])
            )
            for load_n, fitted in sorted(loads.items()):
                found = fitted.predict(pd.DataFrame([values]))
                point = curve.at_load(load_n)
                assert point is not None
                percent = 100 * (found.mean[0] / point.secant_n_per_mm - 1)
                worst[name] = max(worst.get(name, 0.0), abs(percent))
                half = 1.96 * found.standard_error[0]
                inside = abs(found.mean[0] - point.secant_n_per_mm) <= half
                print(
                    f"  {name:8s} {load_n:5.0f} N: {point.secant_n_per_mm:8.3f} N/mm, predicted "
                    f"{found.mean[0]:8.3f} ± {half:.3f} "
                    f"({percent:+.3f} %{'' if inside else ', outside its interval'})",
                    flush=True,
                )
    for name, percent in worst.items():
        print(f"largest difference from {name}: {percent:.3f} %")


def main() -> None:
    """Read the arguments and print the comparison."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--models", type=Path, default=Path("results/6_surface/models/joint.json"))
    parser.add_argument("--card", type=Path, default=Path("results/material_card.json"))
    parser.add_argument("--spokes", type=Path, default=Path("results/5_solve/spokes"))
    parser.add_argument("--points", type=int, default=5)
    parser.add_argument("--fe", action="store_true", help="solve by fe_tyre too")
    arguments = parser.parse_args()
    registry = read_registry(arguments.models)
    points = unseen_points(registry, arguments.points)
    (ply,) = read_model(arguments.card, MaterialCard).plies.values()
    report(registry, points, ply.values(), arguments.spokes, arguments.fe)


if __name__ == "__main__":
    main()
