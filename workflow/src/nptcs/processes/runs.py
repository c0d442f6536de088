"""Runs of Snakemake in one folder: which of them are alive, and the locks that dead ones left."""

from __future__ import annotations

import atexit
import fcntl
import os
import shutil
import sys
import time
from collections.abc import Iterator, Mapping
from contextlib import contextmanager, suppress
from pathlib import Path

from nptcs.processes.identity import RUN, ProcessName, lives, process_name, read_name
from nptcs.processes.scratch import release_temporary_files

UNLOCK = "snakemake --unlock"


def begin_run(folder: Path, temporary: Path | None = None) -> bool:
    """Note that this process is a run, and remove the locks of runs that have died.

    Parameters
    ----------
    folder : Path
        Snakemake's own folder, ``.snakemake``, in which it keeps its locks. Snakemake looks at them
        after it has read the Snakefile.
    temporary : Path, optional
        Temporary folder of this run of Snakemake, which the next run removes if this one is killed:
        for a run without our logger, which would have put the folder where it is removed anyway
        (`nptcs.processes.scratch.hold_temporary_files`).

    Returns
    -------
    bool
        Whether an earlier run had died without ending cleanly.
    """
    release_temporary_files()
    os.environ[RUN] = process_name().text()
    noted = folder / "runs"
    noted.mkdir(parents=True, exist_ok=True)
    with _alone(noted):
        runs = {file: _read(file) for file in sorted(noted.glob("*.json"))}
        mine = noted / f"{os.getpid()}.json"
        # an earlier process that had our number is dead
        state = {file: lives(run) if run and file != mine else False for file, run in runs.items()}
        dead = [file for file, alive in state.items() if alive is False]
        if locks := sorted((folder / "locks").glob("*.lock")):
            _settle(locks, runs, state)
        for file in dead:
            _remove_temporary(file)
            file.unlink(missing_ok=True)
        mine.write_text(f"{os.environ[RUN]}\n{temporary or ''}\n", encoding="utf-8")
    atexit.register(_forget, mine, os.getpid())
    return bool(dead)


def begin_job() -> None:
    """Note the Snakemake process that runs single jobs of a run, for example on another machine."""
    release_temporary_files()
    os.environ[RUN] = process_name().text()


def _read(file: Path) -> ProcessName | None:
    try:
        return read_name(file.read_text(encoding="utf-8").partition("\n")[0])
    except (OSError, UnicodeDecodeError):
        return None


def _remove_temporary(note: Path) -> None:
    """Remove the temporary folder that Snakemake had made for a run that has died."""
    with suppress(OSError, UnicodeDecodeError):
        folder = Path(note.read_text(encoding="utf-8").partition("\n")[2].strip())
        if folder.name.startswith("snakemake") and folder.is_dir() and not folder.is_symlink():
            shutil.rmtree(folder, ignore_errors=True)


def _settle(
    locks: list[Path],
    runs: Mapping[Path, ProcessName | None],
    state: Mapping[Path, bool | None],
) -> None:
    """Lift the locks if every run is dead; name the runs that this machine cannot check."""
    if any(state.values()):
        return
    foreign = [runs[file] for file, alive in state.items() if alive is None]
    if foreign:
        _name_foreign(foreign)
    elif state:
        _lift(locks, list(state))


def _lift(locks: list[Path], dead: list[Path]) -> None:
    when = time.strftime("%Y-%m-%d %H:%M", time.localtime(max(f.stat().st_mtime for f in dead)))
    for lock in locks:
        lock.unlink(missing_ok=True)
    print(
        f"The run that began at {when} was killed and none of its processes is alive: its lock is "
        "removed, and this run continues where it stopped.",
        file=sys.stderr,
    )


def _name_foreign(runs: list[ProcessName | None]) -> None:
    where = ", ".join(f"{run.host} (process {run.pid})" for run in runs if run)
    print(
        f"This folder is locked by a run on {where}, and this machine cannot know whether that is "
        f"still running. If it is not: {UNLOCK}, then the same command again.",
        file=sys.stderr,
    )


def _forget(file: Path, pid: int) -> None:
    if os.getpid() == pid:
        with suppress(OSError):
            file.unlink(missing_ok=True)


@contextmanager
def _alone(folder: Path) -> Iterator[None]:
    """Keep two runs that begin at the same time from removing each other's locks."""
    with (folder / "beginning").open("w") as stream:
        fcntl.flock(stream, fcntl.LOCK_EX)
        yield
