"""Why no design is acceptable: which goals exclude each other."""

from __future__ import annotations

import numpy as np

from nptcs.decisions.evaluate import DesignProblem, at_least_all
from nptcs.decisions.search import SearchResult


def conflict_words(problem: DesignProblem, found: SearchResult, probability: float) -> str:
    """Say how near the goals can be met, alone and together.

    Parameters
    ----------
    problem : DesignProblem
    found : SearchResult
        Of a search that found no acceptable design.
    probability : float
        The required probability.

    Returns
    -------
    str
        One line for a table and the terminal.
    """
    each = np.vstack([found.candidates.probabilities, found.designs.probabilities])
    goals = problem.must_hold
    together = float(at_least_all(each).max())
    parts = [f"no design meets all goals with probability {probability:g}: at best {together:.2g}"]
    best = each.max(axis=0)
    alone = [f"'{goal}' with {p:.2g}" for goal, p in zip(goals, best, strict=True)]
    parts.append(f"alone, at best: {', '.join(alone)}")
    if unreachable := [str(g) for g, p in zip(goals, best, strict=True) if p < probability]:
        parts.append(f"out of reach even alone: {' and '.join(unreachable)}")
        return "; ".join(parts)
    for place, goal in enumerate(goals):
        others = float(at_least_all(np.delete(each, place, axis=1)).max())
        if len(goals) > 1 and others >= probability:
            parts.append(f"without '{goal}' the others are met with {others:.2g}: it conflicts")
    return "; ".join(parts)
