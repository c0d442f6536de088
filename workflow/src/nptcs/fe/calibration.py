"""Calibration of the spoke's section, which the paper shows only in a drawing.

Targets: the spoke's stiffness of table 10 and a few named cases of table 5, on the campaign's mesh
and table, by damped Gauss–Newton steps whose slopes are finite differences of spokes and tyres.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from scipy.optimize import lsq_linear

from nptcs.arrays import Array
from nptcs.config.solvers.fe import FeModel, SpokeGeometry
from nptcs.config.solvers.tyre import TyreGeometry
from nptcs.fe.case import loaded_tyre, spoke_design, tyre_model
from nptcs.fe.energy_cache import shared_table
from nptcs.fe.spoke.equilibrium import SpokeError, SpokeModel
from nptcs.fe.spoke.pull import spoke_stiffness
from nptcs.fe.tyre.equilibrium import TyreError

# dimensions that are fitted and their limits (mm, degrees), within which plates end in the block
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
# where the calibration of the default section began, with either ring
START = SpokeGeometry(
    leg_angle_deg=29.5,
    leg_thickness_mm=2.5,
    block_thickness_mm=12.251,
    block_half_length_mm=5.8,
    block_ramp_mm=4.558,
    foot_thickness_mm=13.053,
    foot_taper_mm=10.299,
    plate_foot_gap_mm=5.0,
    plate_mid_gap_mm=5.5,
)
# step of the finite differences; it and the largest step of a round are differences of logarithms
STEP = 0.03
# K_tyre ∝ k_t^0.20 k_c^0.34 of its spoke: least squares over six dimensions of the fiducial design,
# each 3 % larger; over the published tables the exponents' sum is 0.53
TYRE_EXPONENTS = np.array([0.20, 0.34])
LARGEST_STEP = 0.1
HALVINGS = 3


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
class CalibrationProblem:
    """Everything that stays the same during a calibration."""

    model: FeModel
    tyre: TyreGeometry
    ply: Mapping[str, float]
    spokes: tuple[SpokeTarget, ...]
    tyres: tuple[TyreTarget, ...]
    load_n: float
    spoke_cache: Path | None = None
    prior: float = 0.03
    damping: float = 0.05
    # K_tyre ∝ k_spoke^0.53 over the published tables: a spoke's misfit counts half as much
    spoke_weight: float = 1.0
    tyre_weight: float = 2.0

    def with_section(self, free: Array) -> FeModel:
        """Return the model whose free dimensions have these logarithms."""
        change = dict(zip(FREE, np.exp(free).tolist(), strict=True))
        old = self.model.geometry.model_dump()
        made_with = {"calibrated_with": self.model.ring, "calibrated_axial": self.model.axial}
        section = SpokeGeometry(**{**old, **change, **made_with})
        return self.model.model_copy(update={"geometry": section})


@dataclass(frozen=True)
class CalibrationRound:
    """One round: logarithms of the section's free dimensions, and its stiffnesses, N/mm."""

    free: Array
    spoke_stiffness: Array
    tyre_stiffness: Array


def log_spoke_stiffness(
    problem: CalibrationProblem, free: Array, values: Mapping[str, float]
) -> list[float]:
    """Return ln k_t and ln k_c of the spoke of one case."""
    model = problem.with_section(free)
    spoke = SpokeModel(spoke_design(model, problem.tyre, problem.ply, values))
    result = spoke_stiffness(spoke)
    return [float(np.log(fit.slope)) for fit in (result.tension_fit, result.compression_fit)]


def log_tyre_stiffness(
    problem: CalibrationProblem, free: Array, values: Mapping[str, float]
) -> list[float]:
    """Return ln K of one case."""
    model = problem.with_section(free)
    design = spoke_design(model, problem.tyre, problem.ply, values)
    table = shared_table(model, design, problem.spoke_cache)
    assembled = tyre_model(model, problem.tyre, table, values["shear_band_c10_mpa"])
    state = loaded_tyre(assembled, model, problem.load_n)
    return [float(np.log(problem.load_n / state.rise_mm))]


Mapper = Callable[[Callable[..., Any], Iterable[Any]], Iterable[Any]]


def _computed(problem: CalibrationProblem, points: list[Array], mapper: Mapper) -> Array:
    """Logarithms of all stiffnesses at each point: array (points, 2 × spokes + tyres).

    Raises
    ------
    SpokeError, TyreError
        If a spoke or a tyre of these sections cannot be loaded.
    """
    targets = [*problem.tyres, *problem.spokes]
    jobs = [(point, target) for target in targets for point in points]
    found = list(mapper(partial(_job, problem), jobs))
    rows: list[list[float]] = [sum(found[i :: len(points)], []) for i in range(len(points))]
    tyres = len(problem.tyres)
    return np.array([row[tyres:] + row[:tyres] for row in rows])


def _job(problem: CalibrationProblem, job: tuple[Array, SpokeTarget | TyreTarget]) -> list[float]:
    free, target = job
    if isinstance(target, SpokeTarget):
        return log_spoke_stiffness(problem, free, target.values)
    return log_tyre_stiffness(problem, free, target.values)


def calibrate(
    problem: CalibrationProblem,
    rounds: int,
    workers: int,
    report: Callable[[CalibrationRound], None],
) -> FeModel:
    """Find the section by rounds of damped Gauss–Newton steps.

    The slopes are computed at the first section and corrected after every round. A round that
    makes the misfit worse is undone.

    Parameters
    ----------
    problem : CalibrationProblem
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
    best, step, smallest = start, np.zeros_like(start), np.inf
    reached = best_misfit = np.empty(0)
    slopes: Array | None = None
    with ProcessPoolExecutor(workers) as pool:
        for last in range(rounds + 1):
            free, computed = _reach(problem, best, step, pool.map)
            spokes, tyres = np.split(np.exp(computed), [2 * len(problem.spokes)])
            report(CalibrationRound(free.copy(), spokes.reshape(-1, 2), tyres))
            if slopes is not None:
                slopes = _corrected(slopes, free - best, computed - reached)
            misfit = _misfit(problem, computed, free - start)
            if float(misfit @ misfit) < smallest:
                best, reached, best_misfit = free, computed, misfit
                smallest = float(misfit @ misfit)
            if last < rounds:
                if slopes is None:
                    slopes = _slopes(problem, best, pool.map)
                step = _step(problem, slopes, best_misfit, best, problem.damping)
    return problem.with_section(best)


def _reach(
    problem: CalibrationProblem, free: Array, step: Array, mapper: Mapper
) -> tuple[Array, Array]:
    """Take a step, halved while a spoke or tyre of the new section cannot be loaded."""
    for _ in range(HALVINGS + 1):
        moved = free + step
        try:
            return moved, _computed(problem, [moved], mapper)[0]
        except (SpokeError, TyreError) as error:
            failure = error
            step = step / 2.0
    raise failure


def _slopes(problem: CalibrationProblem, free: Array, mapper: Mapper) -> Array:
    """∂ ln (stiffness) / ∂ ln (dimension): array (stiffnesses, dimensions).

    The first tyre is solved again for each dimension. The slopes of the others follow from their
    spokes by `TYRE_EXPONENTS`, plus the error of this law for the first tyre: a dimension may
    change how a spoke resists shear or rotation of the band, which its two stiffnesses do not
    show. Near a limit the difference is taken away from it, so that every section is valid.
    """
    _, high = _limits()
    steps = np.where(free + STEP > high, -STEP, STEP)
    points = [free, *(free + np.diag(steps))]
    targets: list[SpokeTarget | TyreTarget] = [*problem.spokes, *problem.tyres]
    jobs = [(point, target.values) for target in targets for point in points]
    found = np.array(list(mapper(partial(_spoke_job, problem), jobs)))
    found = found.reshape(len(targets), len(points), 2)
    slopes = (found[:, 1:] - found[:, :1]) / steps[:, None]
    spokes, tyres = np.split(slopes, [len(problem.spokes)])
    by_law = tyres @ TYRE_EXPONENTS
    solved = np.array(
        list(mapper(partial(_job, problem), [(point, problem.tyres[0]) for point in points]))
    )
    missed = (solved[1:, 0] - solved[0, 0]) / steps - by_law[0]
    return np.concatenate([spokes.swapaxes(1, 2).reshape(-1, len(FREE)), by_law + missed])


def _corrected(slopes: Array, step: Array, change: Array) -> Array:
    """Correct the slopes so that they give the change over the last step (Broyden's update)."""
    corrected: Array = slopes + np.outer(change - slopes @ step, step) / (step @ step)
    return corrected


def _spoke_job(problem: CalibrationProblem, job: tuple[Array, Mapping[str, float]]) -> list[float]:
    return log_spoke_stiffness(problem, *job)


def _limits() -> Array:
    limits: Array = np.log(np.array(list(LIMITS.values()))).T
    return limits


def _weights(problem: CalibrationProblem) -> Array:
    spokes = np.full(2 * len(problem.spokes), problem.spoke_weight)
    return np.concatenate([spokes, np.full(len(problem.tyres), problem.tyre_weight)])


def _misfit(problem: CalibrationProblem, computed: Array, moved: Array) -> Array:
    """Weighted differences of the logarithms; the prior pulls towards the first section."""
    wanted = [k for t in problem.spokes for k in (t.tension_n_per_mm, t.compression_n_per_mm)]
    wanted += [t.stiffness_n_per_mm for t in problem.tyres]
    return np.concatenate([_weights(problem) * (computed - np.log(wanted)), problem.prior * moved])


def _step(
    problem: CalibrationProblem, slopes: Array, misfit: Array, free: Array, damping: float
) -> Array:
    """Find the next step by least squares within the limits."""
    jacobian = [
        _weights(problem)[:, None] * slopes,
        problem.prior * np.eye(len(FREE)),
        damping * np.eye(len(FREE)),
    ]
    low, high = _limits()
    room = np.maximum(free - low, 1e-6), np.maximum(high - free, 1e-6)
    bounds = -np.minimum(room[0], LARGEST_STEP), np.minimum(room[1], LARGEST_STEP)
    wanted = np.concatenate([-misfit, np.zeros(len(FREE))])
    step: Array = lsq_linear(np.concatenate(jacobian), wanted, bounds).x
    return step
