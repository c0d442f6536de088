"""How far the cases of a job are: a line per case in its log, and a small file for the screen.

The file is replaced at most once per `PAUSE_S`; `nptcs.monitor` reads it while the run goes on.
"""

from __future__ import annotations

import json
import time
from contextlib import suppress
from pathlib import Path
from statistics import median
from typing import TYPE_CHECKING, TypedDict, cast

if TYPE_CHECKING:
    from nptcs.campaign.record import CaseRecord

PAUSE_S = 0.5
RECENT = 200
"""Cases from whose measured times the time of the others is estimated."""


class Progress(TypedDict):
    """What the file says about the cases of one study by one solver, or about a part of them."""

    study: str
    solver: str
    done: int
    total: int
    failed: int
    left_s: float | None


def progress_file(log: str | Path) -> Path:
    """Return the file next to a job's log that says how far its cases are."""
    return Path(log).with_suffix(".progress.json")


class ProgressWriter:
    """Writes how far the cases of a job are.

    Parameters
    ----------
    log : str or Path
        Log of the job; gets a line for each case or part of a table.
    study, solver : str
    at_a_time : int
        Cases that run side by side.
    """

    def __init__(self, log: str | Path, study: str, solver: str, at_a_time: int) -> None:
        self.log, self.file = Path(log), progress_file(log)
        self.study, self.solver, self.at_a_time = study, solver, at_a_time
        self.seconds: list[float] = []
        self.failed = 0
        self.written = 0.0

    def case(self, record: CaseRecord, reused: bool, done: int, total: int) -> None:
        """Note a case that has ended, or that was known."""
        status, message = record.result.status, record.result.message
        how = "known" if reused else f"{record.wall_time_s:.2f} s"
        why = "" if status.solved else f": {message}"
        self.failed += not status.solved
        if not reused:
            self.seconds.append(record.wall_time_s)
        self._line(f"{done}/{total} {record.case_id} {status} ({how}){why}")
        left = None
        if self.seconds:
            left = (total - done) * median(self.seconds[-RECENT:]) / self.at_a_time
        self._write(done, total, left)

    def part(self, done: int, total: int, failed: int, seconds: float, solved: int) -> None:
        """Note a part of a table: `solved` cases took `seconds` together so far."""
        self.failed = failed
        self._line(f"{done}/{total} cases, {failed} failed")
        self._write(done, total, (total - done) * seconds / solved if solved else None)

    def _line(self, text: str) -> None:
        """Add to the log; a log that cannot be written does not stop a case."""
        with suppress(OSError), self.log.open("a", encoding="utf-8") as stream:
            stream.write(f"{self.study}/{self.solver} {text}\n")

    def _write(self, done: int, total: int, left_s: float | None) -> None:
        now = time.monotonic()
        if done < total and now - self.written < PAUSE_S:
            return
        self.written = now
        content = Progress(
            study=self.study,
            solver=self.solver,
            done=done,
            total=total,
            failed=self.failed,
            left_s=left_s,
        )
        with suppress(OSError):
            temporary = self.file.with_suffix(".tmp")
            temporary.write_text(json.dumps(content), encoding="utf-8")
            temporary.replace(self.file)


def read_progress(log: str | Path) -> Progress | None:
    """Read how far the cases of a job are; None while nothing is known."""
    try:
        content = json.loads(progress_file(log).read_text(encoding="utf-8"))
        return cast(Progress, {name: content[name] for name in Progress.__annotations__})
    except (OSError, ValueError, KeyError, TypeError):
        return None
