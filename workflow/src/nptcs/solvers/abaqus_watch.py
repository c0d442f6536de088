"""Watching an Abaqus job, so that neither a queue for tokens nor a wrong model costs hours."""

from __future__ import annotations

import time
from collections.abc import Sequence
from pathlib import Path

from nptcs.solvers.abaqus_messages import read_messages, waits_for_licence
from nptcs.solvers.contract import Status
from nptcs.solvers.external import CommandStopped

READ_EVERY_S = 2.0
"""Time between two looks at the job's files."""


class JobWatch:
    """Stops a job that queues too long for its licence, or warns that it solves a different model.

    Parameters
    ----------
    job : Path
        The job's files without their suffixes; they may not exist yet.
    licence_wait_s : float
        Time that the job may queue without interruption, s.
    accepted_warnings : sequence of str
        Regular expressions of warnings that are not fatal although they look so.
    """

    def __init__(self, job: Path, licence_wait_s: float, accepted_warnings: Sequence[str]) -> None:
        self._job = job
        self._licence_wait_s = licence_wait_s
        self._accepted = accepted_warnings
        self._queued_since: float | None = None
        self._next_look = 0.0

    def __call__(self, printed: str) -> None:
        """Look at the job now.

        Raises
        ------
        CommandStopped
            With status ``licence`` or ``error``.
        """
        now = time.monotonic()
        if now < self._next_look:
            return
        self._next_look = now + min(READ_EVERY_S, self._licence_wait_s / 4.0)
        if not waits_for_licence(printed + text_of(self._job, "log")):
            self._queued_since = None
        elif self._queued_since is None:
            self._queued_since = now
        elif now - self._queued_since >= self._licence_wait_s:
            message = f"no licence after {self._licence_wait_s:g} s (licence_wait_s)"
            raise CommandStopped(Status.LICENCE, message)
        texts = [text_of(self._job, kind) for kind in ("dat", "msg")]
        found = read_messages(texts, self._accepted)
        if found.fatal:
            raise CommandStopped(Status.ERROR, " | ".join(found.fatal))


def text_of(job: Path, kind: str) -> str:
    """Return the content of one of the job's files; an empty text if there is none."""
    path = job.with_suffix(f".{kind}")
    return path.read_text(encoding="utf-8", errors="replace") if path.exists() else ""
