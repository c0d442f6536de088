"""The state of a run, from Snakemake's events and the files of the jobs that solve cases."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from nptcs.campaign.progress import Progress, read_progress

SOLVING = ("solve", "solve_bulk")


@dataclass(frozen=True)
class Job:
    """A job of Snakemake: its rule, what it is about, and its log."""

    rule: str
    about: str
    log: str

    def __str__(self) -> str:
        return f"{self.rule} {self.about}".strip()


@dataclass
class Run:
    """What is known of a run.

    Parameters
    ----------
    total, done : int
        Jobs; `total` is 0 before the run has begun.
    jobs : dict of int to Job
        Those that have begun, by Snakemake's number.
    failed : list of Job
    solved : dict of (str, str) to dict of str to Progress
        How far the cases are: by study and solver, then by the log of the job.
    """

    total: int = 0
    done: int = 0
    jobs: dict[int, Job] = field(default_factory=dict)
    failed: list[Job] = field(default_factory=list)
    solved: dict[tuple[str, str], dict[str, Progress]] = field(default_factory=dict)

    def job_info(self, event: Mapping[str, Any]) -> None:
        """Note a job that is about to begin."""
        self.jobs[int(event["jobid"])] = job_of(event)

    def job_failed(self, event: Mapping[str, Any]) -> Job:
        """Note a job that failed."""
        job = self.jobs.get(int(event["jobid"])) or job_of(event)
        if job not in self.failed:
            self.failed.append(job)
        return job

    def look(self) -> None:
        """Read the progress of all jobs that solve cases."""
        for job in self.jobs.values():
            progress = read_progress(job.log) if job.rule in SOLVING and job.log else None
            if progress is not None:
                name = progress["study"], progress["solver"]
                self.solved.setdefault(name, {})[job.log] = progress

    def campaigns(self) -> list[Progress]:
        """Add up the progress of each study, solver by solver."""
        return [_sum(list(parts.values())) for parts in self.solved.values()]


def job_of(event: Mapping[str, Any]) -> Job:
    """Describe the job of an event."""
    wildcards = event.get("wildcards") or {}
    logs: Sequence[str] = event.get("log") or []
    rule = str(event.get("rule_name", ""))
    return Job(rule, " ".join(str(value) for value in wildcards.values()), next(iter(logs), ""))


def _sum(parts: Sequence[Progress]) -> Progress:
    left = [part["left_s"] for part in parts if part["left_s"] is not None]
    return Progress(
        study=parts[0]["study"],
        solver=parts[0]["solver"],
        done=sum(part["done"] for part in parts),
        total=sum(part["total"] for part in parts),
        failed=sum(part["failed"] for part in parts),
        left_s=max(left) if left else None,
    )
