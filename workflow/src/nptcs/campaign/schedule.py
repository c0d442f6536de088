"""How many cases of a batch run side by side, and what they need together."""

from __future__ import annotations

from math import ceil
from typing import Protocol

from nptcs.errors import InputError

WORTH_A_CORE_S = 5.0
"""Time of cases, as stated, that is worth another core: to start cases takes about a second."""


class Needs(Protocol):
    """What a case needs: options of a solver, or `nptcs.start.facts.SolverFacts`."""

    def cores_per_case(self) -> int:
        """Return the cores that one case keeps busy."""

    def tokens_per_case(self) -> int:
        """Return the licence tokens that one case takes."""


class TimedNeeds(Needs, Protocol):
    """Needs of a case whose usual time is stated."""

    @property
    def case_s(self) -> float:
        """Wall time that a case usually takes."""


def batch_cores(cores_per_batch: int, options: TimedNeeds, cases: float) -> int:
    """Return the cores that a batch requests: at least those of one case.

    A batch of cheap cases requests fewer than `cores_per_batch`, and so runs next to others.

    Parameters
    ----------
    cores_per_batch : int
        Of the configuration.
    options : TimedNeeds
    cases : float
        Cases of the batch, in the mean of a study's batches.
    """
    useful = ceil(cases * options.case_s / WORTH_A_CORE_S)
    return max(min(cores_per_batch, useful), options.cores_per_case())


def batch_tokens(cores: int, options: Needs) -> int:
    """Return the licence tokens of all cases that a batch runs side by side on its cores."""
    return options.tokens_per_case() * max(1, cores // options.cores_per_case())


def cases_side_by_side(cores: int, tokens: int, options: Needs) -> int:
    """Return how many cases a batch may run at a time.

    Parameters
    ----------
    cores : int
        Cores that the batch was given; fewer than it requested if ``-j`` is small.
    tokens : int
        Licence tokens that it was given; Snakemake reduces what a job requests to the limit of
        ``--resources licence_tokens=N``.
    options : Needs

    Raises
    ------
    InputError
        If the cores or tokens are too few for one case.
    """
    per_case = {"cores": options.cores_per_case(), "licence tokens": options.tokens_per_case()}
    given = {"cores": cores, "licence tokens": tokens}
    remedies = {
        "cores": "raise -j, or lower `cpus`",
        "licence tokens": "raise --resources licence_tokens=N, or lower `cpus` or `licence_tokens`",
    }
    for name, needed in per_case.items():
        if given[name] < needed:
            raise InputError(
                f"one case takes {needed} {name}, but this run has {given[name]}", remedies[name]
            )
    by_tokens = tokens // per_case["licence tokens"] if per_case["licence tokens"] else cores
    return min(cores // per_case["cores"], by_tokens)
