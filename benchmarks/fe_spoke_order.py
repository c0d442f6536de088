"""Spoke tables of the two published studies, each computed with the help of the earlier ones.

    python benchmarks/fe_spoke_order.py FOLDER [--order natural|spread] [--first N]

Processor time and Newton iterations of each spoke, and the stiffness of its tyre; FOLDER keeps the
tables. Two runs with different orders into two folders show what the order changes.
"""

from __future__ import annotations

import argparse
import time
from itertools import product
from pathlib import Path

import numpy as np
from threadpoolctl import threadpool_limits

from nptcs.arrays import Array
from nptcs.config.fe import FeModel
from nptcs.config.tyre import TyreGeometry
from nptcs.fe.case import loaded_tyre, spoke_design, tyre_model
from nptcs.fe.energy_cache import shared_table
from nptcs.fe.spoke.equilibrium import SpokeModel
from nptcs.tables.material_card import PUBLISHED_PLY

NAMES = ("spacing_mm", "thickness_mm", "angle_deg", "spoke_c10_mpa")
BAND_C10_MPA, LOAD_N = 5.0, 5000.0


def spokes() -> list[tuple[float, ...]]:
    """Spokes of tables 5 and 7 in the order of their cases."""
    plates = product(
        (10.0, 15.0, 20.0), (1.2, 1.8, 2.4), np.arange(0.0, 91.0, 15.0).tolist(), (1.04,)
    )
    return [*plates, *((15.0, 1.8, 45.0, c10) for c10 in (1.0, 2.0, 3.0, 4.0, 5.0))]


def spread(points: Array) -> list[int]:
    """Return the order in which each point is the farthest from all earlier ones."""
    scaled = (points - points.min(axis=0)) / np.ptp(points, axis=0)
    order = [int(np.abs(scaled - scaled.mean(axis=0)).sum(axis=1).argmin())]
    while len(order) < len(points):
        distance = np.linalg.norm(scaled[:, None] - scaled[order], axis=2).min(axis=1)
        order.append(int(distance.argmax()))
    return order


@threadpool_limits.wrap(limits=1)
def main(folder: Path, order: str, first: int) -> None:
    """Compute the spokes and print one line for each."""
    model, tyre, iterations = FeModel(), TyreGeometry(), []
    settle = SpokeModel._respond

    def counted(self: SpokeModel, displacement: Array) -> object:
        iterations.append(1)
        return settle(self, displacement)

    SpokeModel._respond = counted  # type: ignore[method-assign, assignment]
    designs = spokes()
    numbers = range(len(designs)) if order == "natural" else spread(np.array(designs))
    for number in list(numbers)[:first]:
        values = dict(zip(NAMES, designs[number], strict=True))
        before, start = len(iterations), time.process_time()
        design = spoke_design(model, tyre, PUBLISHED_PLY, values)
        table = shared_table(model, design, folder)
        spent, count = time.process_time() - start, len(iterations) - before
        state = loaded_tyre(tyre_model(model, tyre, table, BAND_C10_MPA), model, LOAD_N)
        print(f"{values}: {count} iterations, {spent:.1f} s, {LOAD_N / state.rise_mm:.4f} N/mm")


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--order", choices=("natural", "spread"), default="natural")
    parser.add_argument("--first", type=int, default=len(spokes()))
    arguments = parser.parse_args()
    main(arguments.folder, arguments.order, arguments.first)
