"""Time and failures of the ring solver: a curve of twelve points, and many random designs.

    python benchmarks/ring_speed.py [--designs 10000] [--workers 1] [--spoke-tables 3]

Prints the CPU time of a curve with each kernel, the best of ten; then solves random designs (band
C10 2 to 10 MPa, tread C10 2 to 10, load 500 to 6000 N, factor of the spokes' energy 0.8 to 1.25,
friction 0 to 0.8) on spokes of section 4.3.1 and counts how they ended. `beyond_table` is a limit
of the spoke; `diverged` would be a failure.
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Mapping

import numpy as np
import pandas as pd
from scipy.stats import qmc

from nptcs.config.solvers.fe import FeModel
from nptcs.config.solvers.ring import RingOptions
from nptcs.config.solvers.tyre import TyreGeometry
from nptcs.fe.case import energy_table, spoke_design
from nptcs.fe.spoke.energy_table import SpokeEnergyTable
from nptcs.ring.batch import NamedTables, solve_table
from nptcs.ring.kernel.compiled import HAS_NUMBA
from nptcs.ring.solution import press_through_loads
from nptcs.ring.tyre import ring_tyre
from nptcs.tables.laboratory.material_card import PUBLISHED_PLY

TYRE = TyreGeometry()
POINTS = 12
LOAD_N = 5000.0
LOW = np.array([2.0, 2.0, 500.0, 0.8, 0.0])
HIGH = np.array([10.0, 10.0, 6000.0, 1.25, 0.8])
COLUMNS = ("shear_band_c10_mpa", "tread_c10_mpa", "load_n", "spoke_factor", "friction")


def spoke_tables(count: int) -> dict[str, SpokeEnergyTable]:
    """Compute tables of the fiducial spoke with C10 from 1 to 5 MPa."""
    model = FeModel()
    plates = {"spacing_mm": 15.0, "thickness_mm": 1.8, "angle_deg": 45.0}
    return {
        f"{c10:g}": energy_table(
            model, spoke_design(model, TYRE, PUBLISHED_PLY, {**plates, "spoke_c10_mpa": c10})
        )
        for c10 in np.linspace(1.0, 5.0, count)
    }


def reference_loop_s() -> float:
    """CPU time of a loop of plain Python, by which the speeds of machines and of hours compare."""
    start = time.process_time()
    total = 0.0
    for number in range(100_000):
        total += 0.5 * number
    return time.process_time() - start


def time_curves(table: SpokeEnergyTable) -> None:
    """Print the time of a curve with each kernel."""
    loads = np.linspace(0.0, LOAD_N, POINTS + 1)[1:].tolist()
    for kernel in ("numpy", "numba") if HAS_NUMBA else ("numpy",):
        tyre = ring_tyre(TYRE, table, 5.0, RingOptions(), kernel=kernel)
        press_through_loads(tyre, loads)
        times, reference = [], []
        for _ in range(10):
            start = time.process_time()
            states = press_through_loads(tyre, loads)
            times.append(time.process_time() - start)
            reference.append(reference_loop_s())
        count = sum(state.iterations for state in states)
        print(
            f"{kernel:6s} {POINTS} points, {len(tyre.nodes.theta)} nodes: {1000 * min(times):.1f} "
            f"ms CPU, {min(times) / min(reference):.2f} reference loops, {count} iterations"
        )


def solve_random(tables: Mapping[str, SpokeEnergyTable], count: int, workers: int) -> pd.DataFrame:
    """Solve random designs and print how they ended."""
    points = qmc.Sobol(len(LOW) + 1, seed=4).random_base2(int(np.ceil(np.log2(count))))[:count]
    rows = pd.DataFrame(LOW + points[:, 1:] * (HIGH - LOW), columns=list(COLUMNS))
    names = sorted(tables)
    rows["spoke"] = [names[int(place * len(names))] for place in points[:, 0]]
    start, clock = time.process_time(), time.perf_counter()
    found = solve_table(rows, NamedTables(tables), TYRE, RingOptions(), workers=workers)
    print(
        f"{count} designs: {time.perf_counter() - clock:.0f} s, {time.process_time() - start:.0f} "
        f"s CPU in this process; {found['status'].value_counts().to_dict()}"
    )
    for text in found.loc[found["status"] == "diverged", "message"]:
        print("   ", text)
    return found


def main() -> None:
    """Read the arguments and print the times."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--designs", type=int, default=10000)
    parser.add_argument("--workers", type=int, default=1)
    parser.add_argument("--spoke-tables", type=int, default=3)
    arguments = parser.parse_args()
    tables = spoke_tables(arguments.spoke_tables)
    time_curves(next(iter(tables.values())))
    solve_random(tables, arguments.designs, arguments.workers)


if __name__ == "__main__":
    main()
