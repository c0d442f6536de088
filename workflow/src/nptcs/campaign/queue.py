"""What a batch of cases requests from a queue: number of jobs, memory, time and licences."""

from __future__ import annotations

from collections.abc import Iterable
from math import ceil
from typing import Protocol

from nptcs.campaign.schedule import TimedNeeds
from nptcs.config.root import Campaign

JOB_MEMORY_MB = 800.0
"""Memory of a job on top of its cases: Snakemake, the script and the server that starts cases."""
JOB_MINUTES = 2.0
"""Time of a job on top of its cases: Snakemake and the imports start again on the node."""
ANSWER_MINUTES = 10.0
"""Time for the uncertainty and the decisions of a run without their confirming cases, which takes
less than two minutes for the default study."""
MARGIN = 2.0
"""Factor on the usual time of cases: a node may be slower, and half of the cases take longer."""


class JobNeeds(TimedNeeds, Protocol):
    """What a job requests from a queue: options of a solver, or `nptcs.start.facts.SolverFacts`."""

    @property
    def case_memory_mb(self) -> float:
        """Memory that a case may need."""

    @property
    def timeout_s(self) -> float:
        """Wall time after which a case is stopped."""


def cases_at_a_time(cores: int, options: JobNeeds) -> int:
    """Return how many cases run side by side on these cores."""
    return max(1, cores // options.cores_per_case())


def batch_count(cases: int, campaign: Campaign, options: JobNeeds) -> int:
    """Return the number of jobs into which the cases of a study are divided for one solver.

    Parameters
    ----------
    cases : int
        Cases of the study.
    campaign : Campaign
        `minutes_per_batch` decides if it is given, otherwise `batches`.
    options : JobNeeds
        Of the solver.

    Examples
    --------
    >>> from nptcs.solvers.contract import SolverOptions
    >>> options = SolverOptions(case_s=20.0)
    >>> batch_count(78, Campaign(batches=3), options)
    3
    >>> batch_count(78, Campaign(minutes_per_batch=5, cores_per_batch=2), options)
    3
    >>> batch_count(2, Campaign(minutes_per_batch=0.01), options)
    2
    """
    if campaign.minutes_per_batch is None:
        return campaign.batches
    at_a_time = cases_at_a_time(campaign.cores_per_batch, options)
    minutes = cases * options.case_s / at_a_time / 60.0
    return min(cases, max(1, ceil(minutes / campaign.minutes_per_batch)))


def batch_memory_mb(cores: int, options: JobNeeds, attempt: int = 1) -> int:
    """Return the memory that a job requests, in MB: its cases' times the attempt, and its own.

    Examples
    --------
    >>> from nptcs.solvers.contract import SolverOptions
    >>> batch_memory_mb(2, SolverOptions(case_memory_mb=300.0))
    1400
    """
    cases = cases_at_a_time(cores, options) * options.case_memory_mb
    return ceil(JOB_MEMORY_MB + cases * attempt)


def batch_minutes(cases: int, batches: int, cores: int, options: JobNeeds, attempt: int = 1) -> int:
    """Return the wall time that a job requests, in minutes.

    Twice the usual time of its cases, times the attempt, and one case more that runs into its
    time limit.

    Examples
    --------
    >>> from nptcs.solvers.contract import SolverOptions
    >>> batch_minutes(78, 3, 2, SolverOptions(case_s=20.0, timeout_s=600.0))
    21
    """
    rounds = ceil(ceil(cases / batches) / cases_at_a_time(cores, options))
    seconds = MARGIN * rounds * options.case_s * attempt + options.timeout_s
    return ceil(JOB_MINUTES + seconds / 60.0)


def confirmation_memory_mb(solvers: Iterable[JobNeeds], attempt: int = 1) -> int:
    """Return the memory that a job requests which solves one case at a time, in MB.

    Examples
    --------
    >>> from nptcs.solvers.contract import SolverOptions
    >>> confirmation_memory_mb([SolverOptions(case_memory_mb=300.0)]), confirmation_memory_mb([])
    (1100, 800)
    """
    return max((batch_memory_mb(1, one, attempt) for one in solvers), default=ceil(JOB_MEMORY_MB))


def confirmation_minutes(solvers: Iterable[tuple[JobNeeds, int]], attempt: int = 1) -> int:
    """Return the wall time that the answers to all decisions request, in minutes.

    Parameters
    ----------
    solvers : iterable of (JobNeeds, int)
        The solver of each decision that is confirmed, and the most cases that it may solve.
    attempt : int

    Examples
    --------
    >>> from nptcs.solvers.contract import SolverOptions
    >>> confirmation_minutes([(SolverOptions(case_s=20.0, timeout_s=600.0), 3)])
    24
    """
    confirmed = sum(batch_minutes(most, 1, 1, one, attempt) for one, most in solvers)
    return ceil(ANSWER_MINUTES * attempt) + confirmed


def licence_request(tokens: int, queue_licence: str) -> str:
    """Return the option by which Slurm reserves licence tokens for a job; empty without any.

    Examples
    --------
    >>> licence_request(5, "abaqus")
    '--licenses=abaqus:5'
    >>> licence_request(5, ""), licence_request(0, "abaqus")
    ('', '')
    """
    return f"--licenses={queue_licence}:{tokens}" if tokens and queue_licence else ""
