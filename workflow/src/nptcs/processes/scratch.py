"""One temporary folder per process that solves cases, which never outlives it for long."""

from __future__ import annotations

import atexit
import os
import shutil
import sys
import tempfile
import time
from functools import cache
from pathlib import Path
from typing import Any

from nptcs.processes.identity import lives, process_name, read_name
from nptcs.processes.marked import WARDEN, end_marked

PREFIX = "nptcs-"
OWNER = "owner.json"
"""File in a scratch folder that names the process to which it belongs."""

SHORT = "/tmp"
LONGEST = 70
"""Characters of a folder's name; a socket's whole name may have 107 (macOS: 103)."""

YOUNG_S = 3600.0
"""A younger folder without an owner's name may just be being made."""


def scratch_folder() -> Path:
    """Return the temporary folder of this process.

    It is made at the first call. A small separate process, the warden, removes it once this
    process has ended, however it ended, and ends the processes that still carry its mark
    (`nptcs.processes.marked`). Folders whose owner and warden were both killed are removed here.
    """
    return _folder_of(os.getpid(), tempfile.gettempdir())


def socket_folder() -> Path:
    """Return a folder of this process whose name is short enough for sockets in it.

    It is the scratch folder, unless the system's temporary folder has a long name, as on clusters.
    """
    folder = scratch_folder()
    return folder if len(str(folder)) <= LONGEST else _folder_of(os.getpid(), SHORT)


def hold_temporary_files() -> None:
    """Put the temporary files of this process into its scratch folder, until they are released.

    Snakemake makes its temporary folder before it reads the Snakefile, and a process that is killed
    removes nothing. The scratch folder is removed whatever happens.
    """
    if sys.platform == "win32":
        return
    folder = scratch_folder()
    tempfile.tempdir = str(folder)
    atexit.register(_remove, folder, os.getpid())


def release_temporary_files() -> None:
    """Put further temporary files, and those of jobs, where the system says."""
    tempfile.tempdir = None


def _remove(folder: Path, pid: int) -> None:
    if os.getpid() == pid:
        shutil.rmtree(folder, ignore_errors=True)


@cache
def _folder_of(pid: int, parent: str) -> Path:
    sweep(Path(parent))
    folder = Path(tempfile.mkdtemp(prefix=PREFIX, dir=parent)).resolve()
    (folder / OWNER).write_text(process_name(pid).text(), encoding="utf-8")
    _start_warden(folder)
    return folder


def sweep(parent: Path) -> list[Path]:
    """Remove the scratch folders in `parent` whose owner has ended; return them."""
    swept = []
    for folder in sorted(parent.glob(f"{PREFIX}*")):
        if folder.is_symlink() or not folder.is_dir() or not os.access(folder, os.W_OK):
            continue
        if _abandoned(folder):
            end_marked(str(folder))
            shutil.rmtree(folder, ignore_errors=True)
            swept.append(folder)
    return swept


def _abandoned(folder: Path) -> bool:
    try:
        owner = read_name((folder / OWNER).read_text(encoding="utf-8"))
    except (OSError, UnicodeDecodeError):
        owner = None
    if owner is not None:
        return lives(owner) is False
    try:
        return not any(folder.iterdir()) and time.time() - folder.stat().st_mtime > YOUNG_S
    except OSError:
        return False


def _start_warden(folder: Path) -> None:
    """Start the warden; the pipe to its input stays open as long as this process lives.

    It has its own session or group from the start, so that no signal to the group of this process
    ends it as well.
    """
    for_warden, _ours = os.pipe()
    command = [sys.executable, str(Path(__file__).with_name(WARDEN)), str(folder), str(os.getpid())]
    quiet = [(os.POSIX_SPAWN_OPEN, number, os.devnull, os.O_WRONLY, 0) for number in (1, 2)]
    actions = [(os.POSIX_SPAWN_DUP2, for_warden, 0), *quiet]
    apart: Any = {"setsid": True} if sys.platform == "linux" else {"setpgroup": 0}
    os.posix_spawn(sys.executable, command, os.environ, file_actions=actions, **apart)
    os.close(for_warden)
