"""One decision from its goals to the designs, with what is known about each."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from nptcs.arrays import Array, Mask
from nptcs.config.studies.decisions import Decision
from nptcs.config.studies.goals import Goal, ResponseName
from nptcs.decisions.conflict import conflict_words
from nptcs.decisions.evaluate import DesignProblem
from nptcs.decisions.search import SearchResult, search
from nptcs.decisions.space import DesignSpace, design_space
from nptcs.uncertainty.source import Source
from nptcs.uncertainty.study_results import StudyResults

SAMPLING_ERROR = 0.01
"""Difference up to which a sampled probability counts as equal to that of the search."""


@dataclass(frozen=True)
class Outcome:
    """A decision that was made, or why none could be.

    Parameters
    ----------
    decision : Decision
    problem : DesignProblem
    space : DesignSpace
    found : SearchResult
    not_assessed : mapping of str to str
        Quantities whose uncertainty is not assessed, with the reason.
    samples : tuple of mapping
        For each design of `found`, samples of every response.
    sampled : ndarray
        Probability of each design from these samples.
    why : str
        Why there is no choice, or what a reader must know about it.
    confidence : float
        Confidence of the intervals.
    """

    decision: Decision
    problem: DesignProblem
    space: DesignSpace
    found: SearchResult
    not_assessed: Mapping[str, str]
    samples: tuple[Mapping[ResponseName, Array], ...]
    sampled: Array
    why: str
    confidence: float

    @property
    def holds(self) -> Mask:
        """Whether the sampled probability of each design is high enough."""
        return sampled_holds(self.sampled, self.decision.with_probability)

    @property
    def choice(self) -> int:
        """Index of the chosen design: the best one that holds; the first one if none does."""
        return int(self.holds.argmax()) if self.found.feasible else 0

    def design(self, place: int) -> dict[str, float]:
        """Return the factors of a design."""
        values = self.found.designs.x[place]
        return {n: float(v) for n, v in zip(self.space.factors, values, strict=True)}


def decide(decision: Decision, source: Source) -> Outcome:
    """Find the designs that meet the goals of a decision.

    Parameters
    ----------
    decision : Decision
    source : Source

    Returns
    -------
    Outcome

    Raises
    ------
    InputError
        For a goal whose response the cases do not have, a factor that does not exist, or cases
        to which no surface can be fitted.
    """
    goals = tuple(_placed(goal, source.results) for goal in decision.goals())
    fitted = {
        goal.response: source.fit(goal.response, decision.surface)
        for goal in {goal.response: goal for goal in goals}.values()
    }
    inputs = source.inputs()
    problem = DesignProblem(goals, fitted, inputs.inputs)
    space = design_space(
        [one.model for one in fitted.values()],
        decision.hold,
        decision.steps,
        source.tyre,
        source.whole_plates,
    )
    found = search(problem, space, decision.with_probability, decision.top)
    samples = tuple(
        problem.sampled(point, source.settings.samples, source.settings.seed)
        for point in found.designs.x
    )
    sampled = np.array([problem.share_that_holds(one) for one in samples])
    why = found.note
    if not found.feasible:
        why = conflict_words(problem, found, decision.with_probability)
    elif not sampled_holds(sampled, decision.with_probability).any():
        short = (
            f"{sampled[0]:.3f} of the choice's samples meet the goals, not "
            f"{decision.with_probability:g}: they are not as normal as the search takes them to be"
        )
        why = "; ".join(filter(None, [found.note, short]))
    return Outcome(
        decision,
        problem,
        space,
        found,
        inputs.not_assessed,
        samples,
        sampled,
        why,
        source.settings.confidence,
    )


def sampled_holds(sampled: Array, asked: float) -> Mask:
    """Tell which sampled probabilities are what was asked for, within `SAMPLING_ERROR`."""
    return np.asarray(sampled >= asked - SAMPLING_ERROR)


def _placed(goal: Goal, results: StudyResults) -> Goal:
    return replace(goal, response=results.at_its_load(goal.response))
