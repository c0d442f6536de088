"""Robustness of the load-bearing model over the range that it is meant for.

    OPENBLAS_NUM_THREADS=1 python benchmarks/lca_sweep.py

Spokes of 1 to 1000 N/mm in tension and in compression, loads of 100 to 20000 N, C10 of 0.5 to
20 MPa, radii of 100 to 1000 mm, all log-uniform. Prints the status of the rows, the largest
balance residual, and the agreement of a sample with collocation of the same equations.
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

import numpy as np

from nptcs import lca
from nptcs.lca.batch import STATUSES

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "tests" / "shared"))

from lca_designs import sweep_designs  # noqa: E402


def by_collocation(designs: dict, row: int, theta_c_deg: float) -> lca.LawState:
    """Solve one row by collocation, for the contact angle that the exact model found."""
    names = list(designs)[:5]
    section = lca.ShearBandSection(*(float(designs[name][row]) for name in names))
    spokes = lca.LinearSpokes(
        float(designs["tension_n_per_mm"][row]), float(designs["compression_n_per_mm"][row])
    )
    law = lca.SpokeLaw.linear(spokes, 2 * section.radius_mm)
    return lca.solve_law(section, law, theta_c_deg=theta_c_deg, contact="paper")


def main() -> None:
    """Solve and print the counts."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--rows", type=int, default=50_000)
    parser.add_argument("--checked", type=int, default=300, help="ok rows for collocation")
    parser.add_argument("--seed", type=int, default=2024)
    chosen = parser.parse_args()
    designs, load = sweep_designs(chosen.rows, chosen.seed)
    batch = lca.solve_batch(designs, load_n=load)
    for status in STATUSES:
        print(f"{status:15s} {np.sum(batch.status == status):7d}")
    solved = np.isin(batch.status, ["ok", "doubtful"])
    residual = np.abs(batch.columns["balance_residual"][solved]).max()
    misfit = np.abs(batch.columns["load_n"][solved] / load[solved] - 1).max()
    print(f"largest balance residual {residual:.1e}, largest misfit of the load {misfit:.1e}")
    worst = 0.0
    for row in np.flatnonzero(batch.status == "ok")[: chosen.checked]:
        state = by_collocation(designs, row, float(batch.columns["theta_c_deg"][row]))
        for name in ("load_n", "displacement_mm", "theta_t_deg"):
            worst = max(worst, abs(getattr(state, name) / batch.columns[name][row] - 1))
    print(f"{chosen.checked} ok rows against collocation: largest relative difference {worst:.1e}")


if __name__ == "__main__":
    main()
