"""Set aside reports that a failed run has not brought up to date: they must not look current."""

from __future__ import annotations

import sys
import time
from collections.abc import Sequence
from pathlib import Path


def set_aside(files: Sequence[str | Path], verdict_log: str | Path, started: float) -> list[Path]:
    """Rename files that a failed run has not confirmed: ``report.html`` → ``report.stale.html``.

    A run that reached its verdict has brought the report up to date, with all problems at its
    top; such a report stays. So does a file that this run has built.

    Parameters
    ----------
    files : sequence of str or Path
        The report and the workbook; those that do not exist are passed over.
    verdict_log : str or Path
        Log of the rule ``verdict``, which is the last one.
    started : float
        When the run began, in seconds since the epoch.

    Returns
    -------
    list of Path
        The new names.
    """
    log = Path(verdict_log)
    if log.is_file() and log.stat().st_mtime >= started:
        print(f"{files[0]} is up to date and lists every problem at its top", file=sys.stderr)
        return []
    renamed = []
    for path in map(Path, files):
        if path.is_file() and path.stat().st_mtime < started:
            stale = stale_name(path)
            path.replace(stale)
            renamed.append(stale)
            print(f"{path} is from an earlier run; it is now {stale}", file=sys.stderr)
    return renamed


def refused(fault: object, page: str | Path) -> str:
    """Say why a run does not begin, and that the report on disk, if any, is of an earlier one.

    A run that was refused has changed nothing: the report and its tables still belong together, so
    they keep their names.
    """
    path = Path(page)
    if not path.is_file():
        return str(fault)
    made = time.strftime("%Y-%m-%d %H:%M", time.localtime(path.stat().st_mtime))
    return (
        f"{fault}\nNothing was run: {path} is dated {made}, from an earlier configuration or sheet."
    )


def stale_name(path: str | Path) -> Path:
    """Return the name of a report that is set aside."""
    path = Path(path)
    return path.with_name(f"{path.stem}.stale{path.suffix}")
