"""Calibration of the spoke's section, which the paper only draws.

Targets: the spoke's stiffness of table 10 and a few named cases of table 5. The stiffness of spokes
and tyres is computed on the campaign's mesh; only its sensitivities, which each step needs for all
dimensions, come from a coarser mesh and table.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import lsq_linear

from nptcs.config.fe import FeModel, SpokeGeometry, SpokeMesh, SpokeTableOptions
from nptcs.config.tyre import TyreGeometry
from nptcs.fe.case import loaded_tyre, spoke_design, spoke_table, tyre_model
from nptcs.fe.spoke import SpokeError, SpokeModel
from nptcs.fe.spoke_pull import spoke_stiffness
from nptcs.fe.tyre import TyreError

Array = NDArray[np.float64]

# dimensions that are fitted and how far they may go (mm, degrees): plates end inside the block
LIMITS = {
    "leg_angle_deg": (15.0, 35.0),
    "leg_thickness_mm": (2.5, 6.0),
    "block_thickness_mm": (8.0, 15.0),
    "block_half_length_mm": (5.8, 10.0),
    "block_ramp_mm": (3.0, 8.0),
    "foot_thickness_mm": (5.0, 14.0),
    "foot_taper_mm": (5.0, 11.0),
    "plate_foot_gap_mm": (1.5, 5.0),
    "plate_mid_gap_mm": (1.5, 5.5),
}
FREE = tuple(LIMITS)
# table 2 of the paper
PUBLISHED_PLY = {
    "e1_mpa": 128000.0,
    "e2_mpa": 8800.0,
    "e3_mpa": 8800.0,
    "nu12": 0.357,
    "nu13": 0.357,
    "nu23": 0.35,
    "g12_mpa": 3147.0,
    "g13_mpa": 3147.0,
    "g23_mpa": 2300.0,
}
# where the calibration of the defaults began
START = FeModel(
    geometry=SpokeGeometry(
        leg_angle_deg=29.64,
        leg_thickness_mm=3.14,
        block_thickness_mm=10.5,
        block_half_length_mm=5.85,
        block_ramp_mm=4.75,
        foot_thickness_mm=13.1,
        foot_taper_mm=10.8,
        plate_foot_gap_mm=4.95,
        plate_mid_gap_mm=5.45,
    )
)
COARSE = {
    "spoke_mesh": SpokeMesh(rows=(1, 1, 2, 1, 1, 1), gap_columns=1),
    "table": SpokeTableOptions(u_r_mm=(-30.0, 8.0), samples=(6, 3, 3), degrees=(8, 4)),
    "load_steps": 4,
}
STEP = 0.03
LARGEST_STEP = 0.15
HALVINGS = 3
# points of the tension and compression curves: of the fit itself, and of its sensitivities
POINTS = (8, 10)
FEW_POINTS = (2, 4)


@dataclass(frozen=True)
class SpokeTarget:
    """Table 10: one rubber's tension and compression stiffness, N/mm."""

    values: Mapping[str, float]
    tension_n_per_mm: float
    compression_n_per_mm: float


@dataclass(frozen=True)
class TyreTarget:
    """One named case of table 5, N/mm."""

    values: Mapping[str, float]
    stiffness_n_per_mm: float


@dataclass(frozen=True)
class Problem:
    """Everything that stays the same during a calibration."""

    model: FeModel
    tyre: TyreGeometry
    ply: Mapping[str, float]
    spokes: tuple[SpokeTarget, ...]
    tyres: tuple[TyreTarget, ...]
    load_n: float
    prior: float = 0.03
    damping: float = 0.05
    spoke_weight: float = 1.5
    tyre_weight: float = 2.0

    def with_section(self, free: Array) -> FeModel:
        """Return the model with other logarithms of the free dimensions."""
        change = dict(zip(FREE, np.exp(free).tolist(), strict=True))
        section = type(self.model.geometry)(**{**self.model.geometry.model_dump(), **change})
        return self.model.model_copy(update={"geometry": section})


@dataclass(frozen=True)
class Round:
    """One round: the section, what it gives and what was asked for."""

    free: Array
    spoke_stiffness: Array
    tyre_stiffness: Array


def log_spoke_stiffness(
    problem: Problem, steps: tuple[int, int], free: Array, values: Mapping[str, float]
) -> Array:
    """Return ln (k_t, k_c) of the spoke of one case."""
    model = problem.with_section(free)
    spoke = SpokeModel(spoke_design(model, problem.tyre, problem.ply, values))
    result = spoke_stiffness(spoke, *steps)
    return np.log([result.tension_fit.slope, result.compression_fit.slope])


def log_tyre_stiffness(problem: Problem, free: Array, values: Mapping[str, float]) -> float:
    """Return ln K of one case."""
    model = problem.with_section(free)
    table = spoke_table(model, spoke_design(model, problem.tyre, problem.ply, values))
    assembled = tyre_model(model, problem.tyre, table, values["shear_band_c10_mpa"])
    state = loaded_tyre(assembled, model, problem.load_n)
    return float(np.log(problem.load_n / state.rise_mm))


Mapper = Callable[[Callable[..., Any], Iterable[Any]], Iterable[Any]]


def _stiffness(
    problem: Problem, points: tuple[int, int], sections: list[Array], mapper: Mapper
) -> tuple[Array, Array]:
    """Compute ln (k_t, k_c), array (sections, spokes, 2), and ln K, array (sections, tyres)."""
    tyre_jobs = [(free, target.values) for free in sections for target in problem.tyres]
    spoke_jobs = [(free, target.values) for free in sections for target in problem.spokes]
    tyres = list(mapper(partial(_tyre_job, problem), tyre_jobs))
    spokes = list(mapper(partial(_spoke_job, problem, points), spoke_jobs))
    return (
        np.array(spokes).reshape(len(sections), len(problem.spokes), 2),
        np.array(tyres).reshape(len(sections), len(problem.tyres)),
    )


def _spoke_job(
    problem: Problem, points: tuple[int, int], job: tuple[Array, Mapping[str, float]]
) -> Array:
    return log_spoke_stiffness(problem, points, *job)


def _tyre_job(problem: Problem, job: tuple[Array, Mapping[str, float]]) -> float:
    return log_tyre_stiffness(problem, *job)


def calibrate(
    problem: Problem, rounds: int, workers: int, report: Callable[[Round], None]
) -> FeModel:
    """Find the section by rounds of damped Gauss–Newton steps.

    A round that makes the misfit worse is taken back and tried again with more damping.

    Parameters
    ----------
    problem : Problem
    rounds : int
    workers : int
        Processes.
    report : callable
        Called with the state of the first section and of each round.

    Returns
    -------
    FeModel
        The model with the best section of all rounds.
    """
    start = np.log([getattr(problem.model.geometry, name) for name in FREE])
    best, step, smallest, damping = start, np.zeros_like(start), np.inf, problem.damping
    with ProcessPoolExecutor(workers) as pool:
        for last in range(rounds + 1):
            free, spokes, tyres = _reach(problem, best, step, pool.map)
            report(Round(free.copy(), np.exp(spokes), np.exp(tyres)))
            misfit = _misfit(problem, spokes, tyres, free - start)
            better = float(misfit @ misfit) < smallest
            damping = damping / 2.0 if better else 4.0 * damping
            if better:
                best, smallest, best_misfit = free, float(misfit @ misfit), misfit
            if last < rounds:
                if better:
                    slopes = _sensitivities(problem, best, pool.map)
                step = _step(problem, slopes, best_misfit, best, damping)
    return problem.with_section(best)


def _reach(
    problem: Problem, free: Array, step: Array, mapper: Mapper
) -> tuple[Array, Array, Array]:
    """Take a step, halved while the new section cannot be loaded; the section and what it gives."""
    for _ in range(HALVINGS + 1):
        try:
            spokes, tyres = _stiffness(problem, POINTS, [free + step], mapper)
            return free + step, spokes[0], tyres[0]
        except (SpokeError, TyreError) as error:
            failure = error
            step = step / 2.0
    raise failure


def _sensitivities(problem: Problem, free: Array, mapper: Mapper) -> Array:
    """Derive ln (k_t, k_c) of the spokes, then ln K, by the logarithms of the dimensions."""
    coarse = replace(problem, model=problem.model.model_copy(update=COARSE))
    sections = [free, *(free + STEP * np.eye(len(FREE)))]
    spokes, tyres = _stiffness(coarse, FEW_POINTS, sections, mapper)
    values = np.concatenate([spokes.reshape(len(sections), -1), tyres], axis=1)
    slopes: Array = (values[1:] - values[0]).T / STEP
    return slopes


def _misfit(problem: Problem, spokes: Array, tyres: Array, moved: Array) -> Array:
    """Weighted differences of the logarithms; the prior pulls towards the first section."""
    wanted = np.log([[t.tension_n_per_mm, t.compression_n_per_mm] for t in problem.spokes])
    target = np.log([t.stiffness_n_per_mm for t in problem.tyres])
    parts = [
        problem.spoke_weight * (spokes - wanted).ravel(),
        problem.tyre_weight * (tyres - target),
        problem.prior * moved,
    ]
    return np.concatenate(parts)


def _step(problem: Problem, slopes: Array, misfit: Array, free: Array, damping: float) -> Array:
    """Least squares within the limits."""
    count = 2 * len(problem.spokes)
    jacobian = [
        problem.spoke_weight * slopes[:count],
        problem.tyre_weight * slopes[count:],
        problem.prior * np.eye(len(FREE)),
        damping * np.eye(len(FREE)),
    ]
    low, high = np.log(np.array(list(LIMITS.values()))).T
    room = np.maximum(free - low, 1e-6), np.maximum(high - free, 1e-6)
    bounds = -np.minimum(room[0], LARGEST_STEP), np.minimum(room[1], LARGEST_STEP)
    wanted = np.concatenate([-misfit, np.zeros(len(FREE))])
    step: Array = lsq_linear(np.concatenate(jacobian), wanted, bounds).x
    return step
