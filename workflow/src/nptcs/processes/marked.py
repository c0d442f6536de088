"""Processes that carry a mark in their environment, and how they are ended.

A command inherits the environment of the case that started it, and so do its own children, whatever
sessions and groups they move to. So all of them are found, even if the case itself was killed.
"""

from __future__ import annotations

import os
import time
from collections.abc import Sequence

import psutil

MARK = "NPTCS_SCRATCH"
"""Environment variable with the folder of a case; folders are below the one of their owner."""

WARDEN = "warden.py"
"""Script that cleans up after a process; it ends by itself."""

POLL_S = 0.03
"""Time between two looks at processes that were asked to end."""

GRACE_S = 1.0
"""Time between the polite and the final signal."""


def end_marked(folder: str) -> None:
    """End all processes whose mark is a folder or below it, politely first; not this one."""
    found = _marked(folder)
    for process in found:
        _send(process, "terminate")
    for process in {*_left(found, GRACE_S), *_marked(folder)}:
        _send(process, "kill")
    _left(found, GRACE_S)


def end_children(wait_s: float) -> None:
    """End all processes that this one has started, and those that they have; politely first.

    Wardens are left alone: they end after this process, and clean up.
    """
    children = [one for one in psutil.Process().children(recursive=True) if not _is_warden(one)]
    for process in children:
        _send(process, "terminate")
    for process in _left(children, wait_s):
        _send(process, "kill")


def _is_warden(process: psutil.Process) -> bool:
    try:
        return any(word.endswith(WARDEN) for word in process.cmdline()[:2])
    except psutil.Error:
        return False


def _marked(folder: str) -> list[psutil.Process]:
    return [process for process in psutil.process_iter() if _has_mark(process, folder)]


def _has_mark(process: psutil.Process, folder: str) -> bool:
    try:
        if process.pid == os.getpid():
            return False
        mark = process.environ().get(MARK, "")
    except (psutil.Error, OSError):
        return False
    return mark == folder or mark.startswith(folder + os.sep)


def _left(processes: Sequence[psutil.Process], wait_s: float) -> list[psutil.Process]:
    """Wait for the end of processes; return those that have not ended by then.

    `psutil.wait_procs` would take from Snakemake the exit codes of its own children.
    """
    end = time.monotonic() + wait_s
    while (left := [one for one in processes if _runs(one)]) and time.monotonic() < end:
        time.sleep(POLL_S)
    return left


def _runs(process: psutil.Process) -> bool:
    try:
        return process.is_running() and process.status() != psutil.STATUS_ZOMBIE
    except psutil.Error:
        return False


def _send(process: psutil.Process, how: str) -> None:
    try:
        getattr(process, how)()
    except psutil.Error:
        return
