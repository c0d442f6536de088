"""Calibration of the spoke's section, which the paper only draws.

Targets: the spoke's stiffness of table 10 and a few named cases of table 5. A tyre costs ten times
as much as a spoke, so the tyre's stiffness is followed by a surrogate in the spoke's stiffness,

    ln K = ln K₀ + β (Δ ln k_t + Δ ln k_c) / 2 ,

that is corrected by a computed tyre for each case at the start of each round (space mapping).
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nptcs.config.fe import FeModel
from nptcs.config.tyre import TyreGeometry
from nptcs.fe.case import loaded_tyre, spoke_design, spoke_table, tyre_model
from nptcs.fe.spoke import SpokeModel
from nptcs.fe.spoke_pull import spoke_stiffness

Array = NDArray[np.float64]

FREE = (
    "leg_angle_deg",
    "leg_thickness_mm",
    "block_thickness_mm",
    "block_half_length_mm",
    "foot_thickness_mm",
    "plate_foot_gap_mm",
    "plate_mid_gap_mm",
)
# K_tyre ∝ k_spoke^0.53 over the published tables
EXPONENT = 0.53
STEP = 0.03
LARGEST_STEP = 0.25


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
    prior: float = 0.1
    spoke_weight: float = 1.0
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


def log_spoke_stiffness(problem: Problem, free: Array, values: Mapping[str, float]) -> Array:
    """Ln (k_t, k_c) of the spoke of one case."""
    model = problem.with_section(free)
    spoke = SpokeModel(spoke_design(model, problem.tyre, problem.ply, values))
    result = spoke_stiffness(spoke)
    return np.log([result.tension_fit.slope, result.compression_fit.slope])


def log_tyre_stiffness(problem: Problem, free: Array, values: Mapping[str, float]) -> float:
    """Ln K of one case."""
    model = problem.with_section(free)
    table = spoke_table(model, spoke_design(model, problem.tyre, problem.ply, values))
    assembled = tyre_model(model, problem.tyre, table, values["shear_band_c10_mpa"])
    state = loaded_tyre(assembled, model, problem.load_n)
    return float(np.log(problem.load_n / state.rise_mm))


Mapper = Callable[[Callable[..., Any], Iterable[Any]], Iterable[Any]]


def _spokes(problem: Problem, points: list[Array], mapper: Mapper) -> Array:
    """Ln (k_t, k_c) for each point and each target: array (points, targets, 2)."""
    cases = [target.values for target in problem.spokes]
    cases += [target.values for target in problem.tyres]
    jobs = [(point, values) for point in points for values in cases]
    rows = list(mapper(partial(_spoke_job, problem), jobs))
    return np.array(rows).reshape(len(points), len(cases), 2)


def _spoke_job(problem: Problem, job: tuple[Array, Mapping[str, float]]) -> Array:
    return log_spoke_stiffness(problem, *job)


def _tyre_job(problem: Problem, job: tuple[Array, Mapping[str, float]]) -> float:
    return log_tyre_stiffness(problem, *job)


def _residual(problem: Problem, spokes: Array, offset: Array, free: Array, start: Array) -> Array:
    """Weighted misfits in per cent, and the pull of the starting section."""
    count = len(problem.spokes)
    wanted = np.log([[t.tension_n_per_mm, t.compression_n_per_mm] for t in problem.spokes])
    spoke = 100.0 * problem.spoke_weight * (spokes[:count] - wanted).ravel()
    target = np.log([t.stiffness_n_per_mm for t in problem.tyres])
    tyre = offset + EXPONENT * spokes[count:].mean(axis=1) - target
    prior = problem.prior * 10.0 * (free - start)
    return np.concatenate([spoke, 100.0 * problem.tyre_weight * tyre, prior])


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
    free = start.copy()
    with ProcessPoolExecutor(workers) as pool:
        for last in range(rounds + 1):
            points = [free] if last == rounds else [free, *(free + STEP * np.eye(len(FREE)))]
            jobs = [(free, target.values) for target in problem.tyres]
            tyres = np.array(list(pool.map(partial(_tyre_job, problem), jobs)))
            spokes = _spokes(problem, points, pool.map)
            report(Round(free.copy(), np.exp(spokes[0]), np.exp(tyres)))
            if last < rounds:
                free = free + _step(problem, spokes, tyres, free, start)
    return problem.with_section(free)


def _step(problem: Problem, spokes: Array, tyres: Array, free: Array, start: Array) -> Array:
    count = len(problem.spokes)
    offset = tyres - EXPONENT * spokes[0, count:].mean(axis=1)
    base = _residual(problem, spokes[0], offset, free, start)
    columns = [
        (_residual(problem, row, offset, free + shift, start) - base) / STEP
        for row, shift in zip(spokes[1:], STEP * np.eye(len(FREE)), strict=True)
    ]
    step: Array = np.linalg.lstsq(np.column_stack(columns), -base)[0].astype(float)
    return step * min(1.0, LARGEST_STEP / float(np.abs(step).max()))
