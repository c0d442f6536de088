"""The search for designs: candidates in every cell, the best of each cell, designs that differ."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.optimize import minimize

from nptcs.arrays import Array, Mask, Rows
from nptcs.config.studies.goals import GoalKind
from nptcs.decisions.evaluate import DesignProblem, Desirability, Evaluation, desirability, nearness
from nptcs.decisions.space import DesignSpace
from nptcs.doe.whole_plates import SPACING

STARTS = 1
"""Candidates per cell from which the search continues."""

NEAREST = 2
"""Candidates from which the nearest design is searched for where none is acceptable."""

SCREENED = 8
"""Candidates per cell at which the inputs are screened."""

FURTHER = 2
"""Cells searched beyond the number of designs to return, and cells searched although they have no
acceptable candidate."""

APART = 0.1
"""Share of a factor's range by which two designs with equally many plates must differ to be listed
as two."""

STEP = 1e-4
"""Step of the search's finite differences, as a share of a factor's range."""


@dataclass(frozen=True)
class SearchResult:
    """What a search has found.

    Parameters
    ----------
    designs : Evaluation
        Designs that meet all targets and bounds with the required probability, the best first, all
        different; if there are none, the nearest one alone.
    desirability : ndarray
        D of these designs.
    feasible : bool
        Whether any design is acceptable.
    candidates : Evaluation
        All candidates, acceptable or not.
    acceptable : ndarray of bool
        Which candidates are acceptable.
    front : Evaluation
        Acceptable candidates and designs that no other one dominates (`pareto`).
    note : str
        What a reader must know about the designs; empty if nothing.
    """

    designs: Evaluation
    desirability: Array
    feasible: bool
    candidates: Evaluation
    acceptable: Mask
    front: Evaluation
    note: str = ""

    @property
    def feasible_percent(self) -> float:
        """Share of the candidates that are acceptable."""
        return float(100 * np.mean(self.acceptable))


def search(
    problem: DesignProblem, space: DesignSpace, probability: float, top: int
) -> SearchResult:
    """Find the designs that meet the goals best.

    Candidates are spread over every cell of the space (each whole number of plates). From the best
    of each promising cell, sequential quadratic programming (SLSQP) improves the desirability while
    all targets and bounds hold with the required probability. The result is moved to values that
    can be made: to the best of those around it that are still acceptable.

    Parameters
    ----------
    problem : DesignProblem
    space : DesignSpace
    probability : float
        Probability with which all targets and bounds must hold together.
    top : int
        Largest number of designs to return.

    Returns
    -------
    SearchResult
    """
    spread = [space.candidates(cell) for cell in space.cells]
    problem = problem.screened(np.vstack([points[:SCREENED] for points in spread]))
    parts = [problem.evaluate(points) for points in spread]
    candidates = joined_evaluations(parts)
    acceptable = candidates.probability >= probability
    if not acceptable.any():
        nearest = nearest_design(problem, space, candidates)
        if nearest.probability[0] < probability:
            none = chosen(candidates, np.zeros(0, dtype=int))
            return SearchResult(nearest, np.zeros(1), False, candidates, acceptable, none)
        scale = desirability(problem, nearest)
        return SearchResult(nearest, scale.of(nearest), True, candidates, acceptable, nearest)
    accepted = chosen(candidates, np.flatnonzero(acceptable))
    scale = desirability(problem, accepted)
    promising = _promising(problem, parts, scale, probability, top)
    best = [_best_of_cell(problem, space, part, scale, probability) for part in promising]
    found = [one for one in best if one is not None]
    rest = _make(problem, space, accepted, scale, top)
    pool = joined_evaluations(
        [*found, chosen(rest, np.flatnonzero(rest.probability >= probability))]
    )
    note = ""
    if not len(pool.x):
        note = "no design in the given steps meets the goals: the choice lies between the steps"
        pool = chosen(accepted, np.array([int(rank(problem, scale, accepted).argmax())]))
    # what was found may be better than any candidate: it has the desirability 1
    scale = desirability(problem, joined_evaluations([accepted, pool]))
    value = rank(problem, scale, pool)
    picked = _different(pool.x, np.argsort(-value, kind="stable"), space, top)
    designs = chosen(pool, picked)
    everything = joined_evaluations([accepted, designs])
    front = chosen(everything, np.flatnonzero(pareto(problem, everything)))
    return SearchResult(designs, scale.of(designs), True, candidates, acceptable, front, note)


def nearest_design(
    problem: DesignProblem, space: DesignSpace, candidates: Evaluation
) -> Evaluation:
    """Return the design that can be made and comes nearest to the goals.

    It has the largest `nearness`, searched from the best candidates (Nelder–Mead).
    """
    order = np.argsort(-nearness(problem.must_hold, candidates), kind="stable")[:NEAREST]
    free = space.free
    found = [candidates.x[place] for place in order]
    if free:
        span = (space.upper - space.lower)[free]
        for start in list(found):

            def shortfall(unit: Array, start: Array = start) -> float:
                point = start.copy()
                point[free] = space.lower[free] + np.clip(unit, 0.0, 1.0) * span
                there = problem.evaluate(point[None, :])
                return -float(nearness(problem.must_hold, there)[0])

            first = (start[free] - space.lower[free]) / span
            ended = minimize(shortfall, first, method="Nelder-Mead", options={"maxfev": 120})
            point = start.copy()
            point[free] = space.lower[free] + np.clip(ended.x, 0.0, 1.0) * span
            found.append(point)
    pool = problem.evaluate(np.unique(np.vstack([space.can_be_made(p) for p in found]), axis=0))
    return chosen(pool, np.array([int(nearness(problem.must_hold, pool).argmax())]))


def rank(problem: DesignProblem, scale: Desirability, found: Evaluation) -> Array:
    """Order of merit: log D, or the probability where no goal has a weight."""
    return scale.logarithm(found) if scale.goals else found.probability


def pareto(problem: DesignProblem, found: Evaluation) -> Mask:
    """Tell which designs are on the Pareto front.

    No other design is at least as good in all objectives and better in one. With one objective
    these are the designs with its best value; without objectives there are none.
    """
    if not problem.objectives:
        return np.zeros(len(found.x), dtype=bool)
    cost = np.column_stack(
        [
            found.mean[goal.response] * (1 if goal.kind is GoalKind.MINIMISE else -1)
            for goal in problem.objectives
        ]
    )
    kept = np.ones(len(cost), dtype=bool)
    for place, row in enumerate(cost):
        better = (cost <= row).all(axis=1) & (cost < row).any(axis=1)
        kept[place] = not better.any()
    return kept


def joined_evaluations(parts: list[Evaluation]) -> Evaluation:
    """Join evaluations of the same problem, one after the other."""
    first = parts[0]
    return Evaluation(
        np.vstack([part.x for part in parts]),
        {name: np.concatenate([part.mean[name] for part in parts]) for name in first.mean},
        {name: np.concatenate([part.sd[name] for part in parts]) for name in first.sd},
        np.vstack([part.probabilities for part in parts]),
    )


def chosen(found: Evaluation, places: Rows) -> Evaluation:
    """Return some of the designs of an evaluation."""
    return Evaluation(
        found.x[places],
        {name: values[places] for name, values in found.mean.items()},
        {name: values[places] for name, values in found.sd.items()},
        found.probabilities[places],
    )


def _promising(
    problem: DesignProblem,
    parts: list[Evaluation],
    scale: Desirability,
    probability: float,
    top: int,
) -> list[Evaluation]:
    """Choose the cells in which the search continues.

    Those with the best acceptable candidates, and of those without any the most probable ones.
    """
    acceptable = [part.probability >= probability for part in parts]
    merit = [
        float(rank(problem, scale, part)[holds].max()) if holds.any() else -np.inf
        for part, holds in zip(parts, acceptable, strict=True)
    ]
    order = np.argsort([-value for value in merit], kind="stable")
    with_any = [parts[n] for n in order if np.isfinite(merit[n])]
    nearest = sorted(
        (part for part, value in zip(parts, merit, strict=True) if not np.isfinite(value)),
        key=lambda part: -float(part.probability.max()),
    )
    return [*with_any[: top + FURTHER], *nearest[:FURTHER]]


def _best_of_cell(
    problem: DesignProblem,
    space: DesignSpace,
    part: Evaluation,
    scale: Desirability,
    probability: float,
) -> Evaluation | None:
    """Return the best design of a cell that can be made; None if none is acceptable."""
    value = np.where(part.probability >= probability, rank(problem, scale, part), -np.inf)
    # a cell without an acceptable candidate may have an acceptable design between its candidates
    order = np.lexsort((-part.probability, -value))[:STARTS]
    starts = part.x[order]
    improved = [_improved(problem, space, start, scale, probability) for start in starts]
    made = np.vstack([space.can_be_made(point) for point in [*starts, *improved]])
    pool = problem.evaluate(np.unique(made, axis=0))
    holds = pool.probability >= probability
    if not holds.any():
        return None
    value = np.where(holds, rank(problem, scale, pool), -np.inf)
    return chosen(pool, np.array([int(value.argmax())]))


def _improved(
    problem: DesignProblem,
    space: DesignSpace,
    start: Array,
    scale: Desirability,
    probability: float,
) -> Array:
    """Improve a design within its cell; the result may be no better."""
    free = space.free
    if not free:
        return start
    span = (space.upper - space.lower)[free]

    seen: dict[bytes, tuple[Array, Array]] = {}

    def around(unit: Array) -> tuple[Array, Array]:
        """Merit and probability at a point, then one step along each factor."""  # noqa: D401
        if (key := unit.tobytes()) not in seen:
            # at the upper edge the step goes inwards
            signs = np.where(unit + STEP > 1.0, -1.0, 1.0)
            units = np.vstack([unit, unit + STEP * np.diag(signs)])
            points = np.repeat(start[None, :], len(units), axis=0)
            points[:, free] = space.lower[free] + np.clip(units, 0.0, 1.0) * span
            found = problem.evaluate(points)
            seen[key] = rank(problem, scale, found), found.probability
        return seen[key]

    def slope(values: Array, unit: Array) -> Array:
        signs = np.where(unit + STEP > 1.0, -1.0, 1.0)
        gradient: Array = (values[1:] - values[0]) / (STEP * signs)
        return gradient

    first = np.clip((start[free] - space.lower[free]) / span, STEP, 1 - STEP)
    ended = minimize(
        lambda unit: -around(unit)[0][0],
        first,
        jac=lambda unit: -slope(around(unit)[0], unit),
        method="SLSQP",
        bounds=[(0.0, 1.0)] * len(free),
        constraints={
            "type": "ineq",
            "fun": lambda unit: around(unit)[1][0] - probability,
            "jac": lambda unit: slope(around(unit)[1], unit),
        },
        options={"maxiter": 20, "ftol": 1e-6},
    )
    point = start.copy()
    point[free] = space.lower[free] + np.clip(ended.x, 0.0, 1.0) * span
    return point


def _make(
    problem: DesignProblem,
    space: DesignSpace,
    acceptable: Evaluation,
    scale: Desirability,
    top: int,
) -> Evaluation:
    """Move the best acceptable candidates to values that can be made."""
    order = np.argsort(-rank(problem, scale, acceptable), kind="stable")
    picked = _different(acceptable.x, order, space, top)
    made = np.vstack([space.can_be_made(acceptable.x[place]) for place in picked])
    return problem.evaluate(np.unique(made, axis=0))


def _different(x: Array, order: Rows, space: DesignSpace, top: int) -> Rows:
    """Pick designs in an order, each different from those before it."""
    span = np.where(space.upper > space.lower, space.upper - space.lower, 1.0)
    picked: list[int] = []
    for place in order:
        apart = [
            np.abs(x[place] - x[other]) / span >= APART
            if not _other_plates(x[place], x[other], space)
            else np.array([True])
            for other in picked
        ]
        if all(one.any() for one in apart):
            picked.append(int(place))
        if len(picked) == top:
            break
    return np.array(picked, dtype=int)


def _other_plates(one: Array, other: Array, space: DesignSpace) -> bool:
    if not space.plates:
        return False
    place = space.factors.index(SPACING)
    counts = [round(space.tread_width_mm / point[place]) for point in (one, other)]
    return counts[0] != counts[1]
