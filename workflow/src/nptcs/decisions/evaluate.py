"""Probability and desirability of designs."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from scipy import stats

from nptcs.arrays import Array
from nptcs.config.studies.goals import Goal, GoalKind, ResponseName
from nptcs.uncertainty.fitted import FittedResponse
from nptcs.uncertainty.inputs import UncertainInput
from nptcs.uncertainty.propagate import assessed, distribution, moments

SMALLEST_SD = 1e-9
"""Share of a response below which its standard deviation counts as zero."""

NEGLIGIBLE = 2e-3
"""Share of the variance below which the search leaves an input out; the samples use all inputs."""

LEAST_DESIRABILITY = 1e-6
"""Desirability of the worst candidate; above zero, because its logarithm must exist."""


@dataclass(frozen=True)
class Evaluation:
    """Predictions of the models at m designs.

    Parameters
    ----------
    x : ndarray of shape (m, n)
    mean, sd : mapping of ResponseName to ndarray of shape (m,)
    probabilities : ndarray of shape (m, goals)
        Probability of each target and bound, in the order of the goals that must hold.
    """

    x: Array
    mean: Mapping[ResponseName, Array]
    sd: Mapping[ResponseName, Array]
    probabilities: Array

    @property
    def probability(self) -> Array:
        """Lower bound of the probability that all hold (Boole), shape (m,)."""
        return at_least_all(self.probabilities)


@dataclass(frozen=True)
class DesignProblem:
    """Goals with the models of their responses.

    Parameters
    ----------
    goals : tuple of Goal
    fitted : mapping of ResponseName to FittedResponse
    inputs : tuple of UncertainInput
    """

    goals: tuple[Goal, ...]
    fitted: Mapping[ResponseName, FittedResponse]
    inputs: tuple[UncertainInput, ...]

    @property
    def must_hold(self) -> tuple[Goal, ...]:
        """Targets and bounds."""
        return tuple(goal for goal in self.goals if goal.must_hold)

    @property
    def objectives(self) -> tuple[Goal, ...]:
        """What is minimised or maximised."""
        return tuple(goal for goal in self.goals if not goal.must_hold)

    def evaluate(self, x: Array) -> Evaluation:
        """Predict all responses at designs of shape (m, n) with mean and standard deviation."""
        mean, sd = {}, {}
        for name, fitted in self.fitted.items():
            followed, _ = assessed(fitted.model, self.inputs)
            found = moments(fitted.model, followed, x)
            mean[name], sd[name] = found.mean, found.sd
        columns = [within(goal, mean[goal.response], sd[goal.response]) for goal in self.must_hold]
        probabilities = np.column_stack(columns) if columns else np.ones((len(x), 0))
        return Evaluation(x, mean, sd, probabilities)

    def screened(self, x: Array) -> DesignProblem:
        """Return the problem without inputs that matter to no response at any of these designs.

        For the search: each input that is left out has less than `NEGLIGIBLE` of the variance.
        """
        largest = np.zeros(len(self.inputs))
        for fitted in self.fitted.values():
            followed, _ = assessed(fitted.model, self.inputs)
            variances = moments(fitted.model, followed, x).variances
            total = np.maximum(variances.sum(axis=1), np.finfo(float).tiny)
            for column, one in enumerate(followed):
                place = next(n for n, other in enumerate(self.inputs) if other is one)
                share = float((variances[:, column] / total).max())
                largest[place] = max(largest[place], share)
        kept = tuple(
            one for one, share in zip(self.inputs, largest, strict=True) if share > NEGLIGIBLE
        )
        return replace(self, inputs=kept)

    def sampled(self, point: Array, samples: int, seed: int) -> dict[ResponseName, Array]:
        """Sample all responses of one design together: each of shape (samples,)."""
        names = list(self.fitted)
        models = [self.fitted[name].model for name in names]
        table = distribution(models, self.inputs, point, samples, seed)
        return {name: table[:, place] for place, name in enumerate(names)}

    def share_that_holds(self, samples: Mapping[ResponseName, Array]) -> float:
        """Return the share of samples in which all targets and bounds hold."""
        holds = [meets(goal, samples[goal.response]) for goal in self.must_hold]
        return float(np.mean(np.all(holds, axis=0))) if holds else 1.0


def within(goal: Goal, mean: Array, sd: Array) -> Array:
    """Probability that a normal response is inside a goal's limits."""
    low, high = goal.limits
    scale = np.maximum(sd, SMALLEST_SD * np.maximum(np.abs(mean), 1e-300))
    inside: Array = stats.norm.cdf((high - mean) / scale) - stats.norm.cdf((low - mean) / scale)
    return inside


def meets(goal: Goal, values: Array) -> Array:
    """Tell which values are inside a goal's limits."""
    low, high = goal.limits
    return np.asarray((values >= low) & (values <= high))


def at_least_all(probabilities: Array) -> Array:
    """Lower bound 1 - Σ (1 - p) of the probability that all goals hold, (m, goals) → (m,)."""
    bound: Array = np.clip(1.0 - (1.0 - probabilities).sum(axis=1), 0.0, 1.0)
    return bound


def nearness(goals: Sequence[Goal], found: Evaluation) -> Array:
    """Rank designs when none is acceptable: the nearest has the largest value, shape (m,).

    The probability minus the largest relative distance of a mean response outside its limits.
    """
    distances = [np.zeros(len(found.x))]
    for goal in goals:
        low, high = goal.limits
        mean = found.mean[goal.response]
        outside = np.maximum(np.maximum(low - mean, mean - high), 0.0)
        limit = low if np.isfinite(low) else high
        distances.append(outside / max(abs(limit), 1e-300))
    result: Array = found.probability - np.max(distances, axis=0)
    return result


@dataclass(frozen=True)
class Desirability:
    """Derringer and Suich's desirability, linear between the worst and the best candidate.

    An objective has 0 at its worst and 1 at its best value among the acceptable candidates, a
    target 1 at its value and 0 at its limits; D is the weighted geometric mean (J. Quality
    Technology 12, 1980, 214).

    Parameters
    ----------
    goals : tuple of Goal
        Those with a weight.
    best, worst : mapping of str to float
        Best and worst value of each objective, by its text.
    """

    goals: tuple[Goal, ...]
    best: Mapping[str, float]
    worst: Mapping[str, float]

    def of(self, found: Evaluation) -> Array:
        """Return D of each design, between 0 and 1, shape (m,); 1 without a weighted goal."""
        return np.exp(np.minimum(self.logarithm(found), 0.0))

    def logarithm(self, found: Evaluation) -> Array:
        """Return log D, not cut at the best candidate: a search may go beyond it."""
        total = sum(goal.weight for goal in self.goals)
        if total == 0:
            return np.zeros(len(found.x))
        logs = [
            goal.weight * np.log(np.maximum(self._single(goal, found), LEAST_DESIRABILITY))
            for goal in self.goals
        ]
        result: Array = np.sum(logs, axis=0) / total
        return result

    def _single(self, goal: Goal, found: Evaluation) -> Array:
        mean = found.mean[goal.response]
        if goal.kind is GoalKind.TARGET:
            closeness: Array = 1.0 - np.abs(mean - goal.value) / goal.plus_minus
            return closeness
        if goal.must_hold:  # a bound is met or not
            return np.where(meets(goal, mean), 1.0, 0.0)
        best, worst = self.best[goal.text], self.worst[goal.text]
        if best == worst:
            return np.ones(len(mean))
        share: Array = (mean - worst) / (best - worst)
        return share


def desirability(problem: DesignProblem, acceptable: Evaluation) -> Desirability:
    """Scale the desirability by the acceptable candidates."""
    best, worst = {}, {}
    for goal in problem.objectives:
        mean = acceptable.mean[goal.response]
        low, high = float(mean.min()), float(mean.max())
        best[goal.text], worst[goal.text] = (
            (low, high) if goal.kind is GoalKind.MINIMISE else (high, low)
        )
    weighted = tuple(goal for goal in problem.goals if goal.weight > 0)
    return Desirability(weighted, best, worst)
