"""Calibration of the spoke's section, which the paper only draws.

Targets: the spoke's stiffness of table 10 and a few named cases of table 5. A tyre costs ten times
as much as a spoke, so the tyre's stiffness is followed by a surrogate in the spoke's stiffness,

    ln K = ln K₀ + β (Δ ln k_t + Δ ln k_c) / 2 ,

that is corrected by a computed tyre for each case at the start of each round (space mapping). The
spoke's sensitivities are computed anew in each round, with coarser steps.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import lsq_linear

from nptcs.config.fe import FeModel, SpokeGeometry
from nptcs.config.tyre import TyreGeometry
from nptcs.fe.case import loaded_tyre, spoke_design, spoke_table, tyre_model
from nptcs.fe.spoke import SpokeError, SpokeModel
from nptcs.fe.spoke_pull import spoke_stiffness
from nptcs.fe.tyre import TyreError

Array = NDArray[np.float64]

# dimensions that are fitted, and how far they may go (mm, degrees)
LIMITS = {
    "leg_angle_deg": (15.0, 35.0),
    "leg_thickness_mm": (2.5, 6.0),
    "block_thickness_mm": (8.0, 15.0),
    "block_half_length_mm": (4.0, 10.0),
    "block_ramp_mm": (3.0, 8.0),
    "foot_thickness_mm": (5.0, 14.0),
    "foot_taper_mm": (5.0, 11.0),
    "plate_foot_gap_mm": (1.5, 5.0),
    "plate_mid_gap_mm": (1.5, 6.0),
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
# where the calibration of the defaults began: found on a coarser mesh, the tyres by the surrogate
START = FeModel(
    geometry=SpokeGeometry(
        leg_angle_deg=30.4,
        leg_thickness_mm=2.86,
        block_thickness_mm=12.2,
        block_half_length_mm=6.08,
        block_ramp_mm=5.1,
        foot_thickness_mm=13.9,
        foot_taper_mm=9.3,
        plate_foot_gap_mm=4.5,
        plate_mid_gap_mm=5.8,
    )
)
# K_tyre ∝ k_spoke^0.53 over the published tables
EXPONENT = 0.53
STEP = 0.03
LARGEST_STEP = 0.15
HALVINGS = 3
# points of the tension and compression curves: of the fit itself, and of its sensitivities
FINE = (8, 10)
COARSE = (2, 4)


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


def _spokes(problem: Problem, steps: tuple[int, int], points: list[Array], mapper: Mapper) -> Array:
    """Return ln (k_t, k_c) for each point and each target: array (points, targets, 2)."""
    cases = [target.values for target in problem.spokes]
    cases += [target.values for target in problem.tyres]
    jobs = [(point, values) for point in points for values in cases]
    rows = list(mapper(partial(_spoke_job, problem, steps), jobs))
    return np.array(rows).reshape(len(points), len(cases), 2)


def _spoke_job(
    problem: Problem, steps: tuple[int, int], job: tuple[Array, Mapping[str, float]]
) -> Array:
    return log_spoke_stiffness(problem, steps, *job)


def _tyre_job(problem: Problem, job: tuple[Array, Mapping[str, float]]) -> float:
    return log_tyre_stiffness(problem, *job)


def calibrate(
    problem: Problem, rounds: int, workers: int, report: Callable[[Round], None]
) -> FeModel:
    """Find the section by rounds of Gauss–Newton steps.

    Parameters
    ----------
    problem : Problem
    rounds : int
    workers : int
        Processes.
    report : callable
        Called with each round's state before its step, and with the last one.

    Returns
    -------
    FeModel
        The model with the calibrated section.
    """
    start = np.log([getattr(problem.model.geometry, name) for name in FREE])
    free, step = start.copy(), np.zeros_like(start)
    with ProcessPoolExecutor(workers) as pool:
        for last in range(rounds + 1):
            free, tyres = _reach(problem, free, step, pool.map)
            spokes = _spokes(problem, FINE, [free], pool.map)[0]
            report(Round(free.copy(), np.exp(spokes), np.exp(tyres)))
            if last < rounds:
                slopes = _sensitivities(problem, free, pool.map)
                step = _step(problem, slopes, spokes, tyres, free, start)
    return problem.with_section(free)


def _reach(problem: Problem, free: Array, step: Array, mapper: Mapper) -> tuple[Array, Array]:
    """Take a step, halved while a tyre of the new section cannot be loaded; ln K of the tyres."""
    for _ in range(HALVINGS + 1):
        moved = free + step
        jobs = [(moved, target.values) for target in problem.tyres]
        try:
            return moved, np.array(list(mapper(partial(_tyre_job, problem), jobs)))
        except (SpokeError, TyreError) as error:
            failure = error
            step = step / 2.0
    raise failure


def _sensitivities(problem: Problem, free: Array, mapper: Mapper) -> Array:
    """∂ ln (k_t, k_c) / ∂ ln (dimension): array (targets, 2, dimensions)."""
    points = [free, *(free + STEP * np.eye(len(FREE)))]
    values = _spokes(problem, COARSE, points, mapper)
    slopes: Array = np.moveaxis((values[1:] - values[0]) / STEP, 0, 2)
    return slopes


def _step(
    problem: Problem, slopes: Array, spokes: Array, tyres: Array, free: Array, start: Array
) -> Array:
    """Weighted least squares; the prior pulls towards the first section, damping to the last."""
    count = len(problem.spokes)
    wanted = np.log([[t.tension_n_per_mm, t.compression_n_per_mm] for t in problem.spokes])
    target = np.log([t.stiffness_n_per_mm for t in problem.tyres])
    misfit = [
        problem.spoke_weight * (spokes[:count] - wanted).ravel(),
        problem.tyre_weight * (tyres - target),
        problem.prior * (free - start),
        np.zeros(len(FREE)),
    ]
    jacobian = [
        problem.spoke_weight * slopes[:count].reshape(-1, len(FREE)),
        problem.tyre_weight * EXPONENT * slopes[count:].mean(axis=1),
        problem.prior * np.eye(len(FREE)),
        problem.damping * np.eye(len(FREE)),
    ]
    low, high = np.log(np.array(list(LIMITS.values()))).T
    room = np.maximum(free - low, 1e-6), np.maximum(high - free, 1e-6)
    bounds = -np.minimum(room[0], LARGEST_STEP), np.minimum(room[1], LARGEST_STEP)
    found = lsq_linear(np.concatenate(jacobian), -np.concatenate(misfit), bounds)
    step: Array = found.x
    return step
