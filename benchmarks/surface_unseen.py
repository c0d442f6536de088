"""Surfaces of the plate study against finite element cases that they have not seen.

    python benchmarks/surface_unseen.py [--results results] [--solver fe_tyre_paper] [--seed 11]
        [--config config/config.yaml] [--surface "gaussian process on lamination 7"]

Solves eight designs inside the box of a finished run: three that were chosen by hand and five by
a random generator of fixed seed. Prints what the surface predicts for the values that the solver
realised, its 95 % interval, and the difference. Solved designs are kept in the run's record store.
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

import numpy as np
import pandas as pd
import yaml

from nptcs.campaign.cases import cases_table
from nptcs.campaign.jobs import make_jobs
from nptcs.campaign.record import RecordStore
from nptcs.campaign.runner import run_cases
from nptcs.config.root import read_config
from nptcs.decisions.confirm import say
from nptcs.files import read_model
from nptcs.surface.cases import as_realised
from nptcs.surface.response_surface import predict
from nptcs.surface.stored import read_registry
from nptcs.surface.study import RESPONSE
from nptcs.tables.laboratory.material_card import MaterialCard

FACTORS = ["spacing_mm", "thickness_mm", "angle_deg"]
BY_HAND = [(10.5, 1.3, 0.0), (12.5, 1.5, 37.5), (14.05, 1.8, 45.0)]
LOW, HIGH = np.array([10.0, 1.2, 0.0]), np.array([20.0, 2.4, 90.0])


def designs(seed: int, number: int = 5) -> pd.DataFrame:
    """Return the designs by hand and `number` random ones in the box, rounded as one orders plates.

    Spacings end at 19 mm: a wider one is realised outside the box.
    """
    random = LOW + np.random.default_rng(seed).random((number, 3)) * (HIGH - LOW)
    random = np.column_stack([random[:, 0].clip(None, 19.0).round(1), random[:, 1:].round(2)])
    table = pd.DataFrame([*BY_HAND, *random.tolist()], columns=FACTORS)
    table.insert(0, "case_id", [f"unseen_{place + 1:02d}" for place in range(len(table))])
    return table


def main() -> int:
    """Solve, predict, print; exit code 1 if a bound is missed."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n", 1)[0])
    parser.add_argument("--results", type=Path, default=Path("results"))
    parser.add_argument("--config", type=Path, default=Path("config/config.yaml"))
    parser.add_argument("--solver", default="fe_tyre_paper")
    parser.add_argument("--surface", default="gaussian process on lamination 7")
    parser.add_argument("--seed", type=int, default=11)
    parser.add_argument("--cores", type=int, default=1)
    given = parser.parse_args()
    config = read_config(yaml.safe_load(given.config.read_text("utf-8")), str(given.config))
    study = config.study("plate")
    card = read_model(given.results / "material_card.json", MaterialCard)
    ply = next(iter(card.plies.values())).values()
    table = designs(given.seed).assign(**study.fixed)
    options = config.options_of("plate", given.solver)
    cache = str(given.results / "5_solve" / "spokes")
    options = {**options, "spoke_cache": cache, "plate_stress": "off"}
    jobs = make_jobs(study, given.solver, options, config.tyre, table, ply)
    store = RecordStore(given.results / "5_solve" / "records")
    solved = cases_table(run_cases(jobs, store, given.cores, say))
    x = as_realised(solved, FACTORS)[FACTORS].to_numpy()
    registry = read_registry(given.results / "6_surface" / "models" / "plate.json")
    said = predict(registry.find(RESPONSE, given.solver, given.surface).surface, x)
    truth = solved["vertical_stiffness_n_per_mm"].to_numpy()
    print("| S, T, A | pitch | solver | surface | ± | difference | inside |")
    print("|---|---|---|---|---|---|---|")
    slack = 1e-6 * truth  # a solved tyre that is one of the cases has no interval
    inside = (said.low - slack <= truth) & (truth <= said.high + slack)
    for place, row in enumerate(solved[FACTORS].to_numpy()):
        print(
            f"| {row[0]:g}, {row[1]:g}, {row[2]:g} | {x[place, 0]:.3f} | {truth[place]:.3f} | "
            f"{said.value[place]:.3f} | {(said.high - said.low)[place] / 2:.3f} | "
            f"{said.value[place] - truth[place]:+.3f} | {'yes' if inside[place] else 'NO'} |"
        )
    largest = float(np.abs(said.value - truth).max())
    print(f"largest difference {largest:.3f} N/mm; {inside.sum()} of {len(truth)} inside")
    return 0 if largest <= 0.7 and inside.all() else 1


if __name__ == "__main__":
    sys.exit(main())
