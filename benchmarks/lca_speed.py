"""Speed of the load-bearing model, side by side in one run.

    OPENBLAS_NUM_THREADS=1 python benchmarks/lca_speed.py

A batch of designs on two processes, the same designs with `scipy.integrate.solve_bvp` one by one
(every one that it solves from a rigid wheel's displacement), the agreement of both, and one single
solution from Python. The batch's rate is wall time; what is compared is processor time, which a
busy machine changes less.
"""

from __future__ import annotations

import argparse
import importlib.util
import statistics
import sys
import time
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

import numpy as np

from nptcs import lca
from nptcs.config.solvers.tyre import TyreGeometry
from nptcs.lca.batch import scaled

INDEPENDENT = Path(__file__).resolve().parents[1] / "tests" / "unit" / "lca" / "independent.py"


def tyre_designs(rows: int) -> tuple[dict[str, np.ndarray], np.ndarray]:
    """Draw designs around the published tyre, and loads of 1000 to 8000 N."""
    random = np.random.default_rng(1)
    c10, area = random.uniform(2, 8, rows), 215.0 * 14.0
    designs = {
        "axial_stiffness_n": 2.7018e7 + 6 * c10 * area,
        "shear_stiffness_n": 2 * c10 * area,
        "bending_stiffness_n_mm2": random.uniform(0.5e9, 2e9, rows),
        "radius_mm": random.uniform(250, 350, rows),
        "width_mm": np.full(rows, 215.0),
        "tension_n_per_mm": random.uniform(20, 150, rows),
        "compression_n_per_mm": random.uniform(10, 70, rows),
        "spoke_count": np.full(rows, 60.0),
    }
    return designs, random.uniform(1000, 8000, rows)


def solve_part(part: tuple[dict[str, np.ndarray], np.ndarray]) -> tuple[np.ndarray, np.ndarray]:
    """Solve a part of the table; displacement and status."""
    batch = lca.solve_batch(part[0], load_n=part[1])
    return batch.columns["displacement_mm"], batch.status


def solve_all(pool: ProcessPoolExecutor, designs: dict, load: np.ndarray, parts: int):
    """Divide the table among processes."""
    slices = np.array_split(np.arange(len(load)), parts)
    jobs = [({name: column[s] for name, column in designs.items()}, load[s]) for s in slices]
    solved = list(pool.map(solve_part, jobs))
    return (np.concatenate([piece[i] for piece in solved]) for i in range(2))


def with_solve_bvp(designs: dict, load: np.ndarray, count: int) -> tuple[np.ndarray, list[float]]:
    """Displacements of the first designs by solve_bvp (NaN where it fails), and times."""
    spec = importlib.util.spec_from_file_location("lca_independent", INDEPENDENT)
    independent = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = independent
    spec.loader.exec_module(independent)
    ring, force = scaled(designs), load / designs["shear_stiffness_n"]
    displacement, times = np.full(count, np.nan), []
    for row in range(count):
        numbers = (ring.epsilon, ring.kappa2, ring.compression, ring.tension, force)
        start = time.process_time()
        try:
            answer = independent.linear(
                *(float(values[row]) for values in numbers), (force[row] / 2, 0.9, 0.05)
            )
        except RuntimeError:
            continue
        times.append(time.process_time() - start)
        displacement[row] = answer.sinking * designs["radius_mm"][row]
    return displacement, times


def single_ms() -> float:
    """Median processor time of one solution from Python, in milliseconds."""
    section = lca.ShearBandSection.from_tyre(TyreGeometry(), 5.0)
    times = []
    for load in np.linspace(3000, 6000, 101):
        start = time.process_time()
        lca.solve(section, lca.LinearSpokes(30.2, 13.26), load_n=float(load))
        times.append(time.process_time() - start)
    return 1e3 * statistics.median(times)


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--rows", type=int, default=100_000)
    parser.add_argument("--bvp", type=int, default=200, help="designs for solve_bvp")
    chosen = parser.parse_args()
    designs, load = tyre_designs(chosen.rows)
    with ProcessPoolExecutor(2) as pool:
        list(pool.map(solve_part, [({n: c[:10] for n, c in designs.items()}, load[:10])] * 2))
        start = time.perf_counter()
        displacement, status = solve_all(pool, designs, load, 2)
        batch_s = time.perf_counter() - start
    start = time.process_time()
    solve_part(({name: c[:20_000] for name, c in designs.items()}, load[:20_000]))
    alone_s = (time.process_time() - start) / min(20_000, chosen.rows)
    reference, times = with_solve_bvp(designs, load, chosen.bvp)
    bvp_s = statistics.median(times)
    solved = ~np.isnan(reference)
    difference = np.abs(displacement[: chosen.bvp] / reference - 1)[solved].max()
    print(
        f"batch of {chosen.rows} designs, 2 processes: {batch_s:.2f} s, "
        f"{chosen.rows / batch_s:.0f} designs/s, {np.mean(status == 'ok'):.2%} ok"
    )
    print(f"one process: {alone_s * 1e6:.0f} µs of processor time per design")
    print(
        f"solve_bvp: {bvp_s * 1e3:.0f} ms per design (median), "
        f"{solved.sum()} of {chosen.bvp} solved; ratio {bvp_s / alone_s:.0f}"
    )
    print(f"largest relative difference of the displacement: {difference:.1e}")
    print(f"one solution from Python: {single_ms():.1f} ms of processor time (median)")


if __name__ == "__main__":
    main()
