"""The tyre with all 60 spokes meshed, against the reduced tyre on their energy table.

    python benchmarks/fe_slice.py                    # table 7's S-C 1 and 5 with T-C 5
    python benchmarks/fe_slice.py --rigid-foot       # without the error of the rigid feet
    python benchmarks/fe_slice.py --foot-elements 2  # finer band under the feet

Both models share the ring (plane strain, wires, contact, load control) and the spokes' elements.
The direct one's spokes conform to the band along their whole foot; the reduced one's feet are
rigid, and their energy is a fitted polynomial: the difference is the error of these two together,
and `--rigid-foot` leaves only the polynomial's. Prints load, rise, stiffness, unknowns, time and
memory.
"""

from __future__ import annotations

import argparse
import resource
import time

import numpy as np

from nptcs.config.solvers.fe import FeModel, TyreMesh
from nptcs.config.solvers.tyre import TyreGeometry
from nptcs.fe.case import energy_table, loaded_tyre, spoke_design, tyre_model
from nptcs.fe.tyre.equilibrium import TyreError, TyreModel, TyreState
from nptcs.fe.verification.direct_tyre import DirectTyre
from nptcs.tables.laboratory.material_card import PUBLISHED_PLY


def options() -> argparse.Namespace:
    """Read the command line."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--spoke-c10", type=float, nargs="+", default=[1.0, 5.0], help="MPa")
    parser.add_argument("--band-c10", type=float, default=5.0, help="MPa")
    parser.add_argument("--spacing", type=float, default=15.0, help="mm")
    parser.add_argument("--thickness", type=float, default=1.8, help="mm")
    parser.add_argument("--angle", type=float, default=45.0, help="degrees")
    parser.add_argument("--load", type=float, default=5000.0, help="N")
    parser.add_argument("--rigid-foot", action="store_true")
    parser.add_argument("--foot-elements", type=int, help="elements of the band under a foot")
    return parser.parse_args()


def solve(label: str, tyre: TyreModel, model: FeModel, load_n: float) -> TyreState | None:
    """Load one tyre and print what it took."""
    start, processor = time.perf_counter(), time.process_time()
    try:
        state = loaded_tyre(tyre, model, load_n)
    except TyreError as error:
        print(f"  {label}: {error}", flush=True)
        return None
    print(
        f"  {label}: {load_n:g} N at {state.rise_mm:.4f} mm, {load_n / state.rise_mm:.3f} N/mm; "
        f"{len(state.path.force_n) - 1} steps, {state.path.iterations} iterations, "
        f"{time.perf_counter() - start:.0f} s ({time.process_time() - processor:.0f} s processor)",
        flush=True,
    )
    return state


def compare(direct: TyreState, reduced: TyreState, loads_n: list[float]) -> list[tuple[float, ...]]:
    """Load, rise of both (mm) and difference of the reduced secant stiffness (%), by load."""
    rows: list[tuple[float, ...]] = []
    for load in loads_n:
        rises = [
            float(np.interp(load, state.path.force_n, state.path.rise_mm))
            for state in (direct, reduced)
        ]
        rows.append((load, *rises, 100.0 * (rises[0] / rises[1] - 1.0)))
    return rows


def compare_models(arguments: argparse.Namespace, model: FeModel, values: dict[str, float]) -> None:
    """Solve one design point with both models and print their difference."""
    dimensions = TyreGeometry()
    loads = np.linspace(0.0, arguments.load, model.load_steps + 1)[1:].tolist()
    design = spoke_design(model, dimensions, PUBLISHED_PLY, values)
    table = energy_table(model, design)
    reduced_tyre = tyre_model(model, dimensions, table, arguments.band_c10)
    reduced = solve("reduced", reduced_tyre, model, arguments.load)
    direct_tyre = DirectTyre(
        model, dimensions, design, table, arguments.band_c10, arguments.rigid_foot
    )
    foot = "rigid feet" if arguments.rigid_foot else "conforming feet"
    direct = solve(f"direct, {foot}", direct_tyre, model, arguments.load)
    unstable = sum(not spoke.stable for spoke in direct_tyre.spokes)
    left = max(float(np.abs(spoke.step).max()) for spoke in direct_tyre.spokes)
    print(
        f"  {direct_tyre.unknowns} unknowns; last step of the spokes' nodes {left:.1e} mm; "
        f"spokes unstable on a fixed foot: {unstable}"
    )
    if direct is not None and reduced is not None:
        print("  load (N), rise direct, rise reduced (mm), reduced stiffness differs by (%)")
        for load, *rises, difference in compare(direct, reduced, loads):
            print(f"  {load:8.0f} {rises[0]:9.4f} {rises[1]:9.4f} {difference:+7.2f}")


def main() -> None:
    """Compare the two models at each design point."""
    arguments = options()
    model = FeModel()
    if arguments.foot_elements is not None:
        mesh = {**model.tyre_mesh.model_dump(), "foot_elements": arguments.foot_elements}
        model = model.model_copy(update={"tyre_mesh": TyreMesh(**mesh)})
    for c10 in arguments.spoke_c10:
        values = {
            "spacing_mm": arguments.spacing,
            "thickness_mm": arguments.thickness,
            "angle_deg": arguments.angle,
            "spoke_c10_mpa": c10,
        }
        print(
            f"S-C {c10:g}, T-C {arguments.band_c10:g}, S {arguments.spacing:g}, "
            f"T {arguments.thickness:g}, A {arguments.angle:g}"
        )
        compare_models(arguments, model, values)
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024.0
    print(f"peak memory {peak:.0f} MiB")


if __name__ == "__main__":
    main()
