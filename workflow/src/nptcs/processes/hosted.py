"""The scripts of a run's jobs in forks of one process, instead of a new interpreter for each.

Snakemake has no setting for the way in which it starts the interpreter of a script. So
`host_scripts` replaces the one method that does so, for Python scripts of one folder that need
nothing special. On other systems than Linux, and once the host is gone, Snakemake starts them
itself.
"""

from __future__ import annotations

import atexit
import itertools
import subprocess
import sys
import threading
from collections.abc import Iterable, Mapping
from concurrent.futures import Future
from contextlib import suppress
from multiprocessing import Pipe
from pathlib import Path
from typing import Any

HOST = Path(__file__).with_name("script_host.py")

GRACE_S = 2.0
"""Time that the host has to end."""

IMPORT, HASH, IMPORT_IN_FORK = "import", "hash", "import in a fork"
"""What a host does in advance (`nptcs.processes.script_host.TASKS`)."""

SPECIAL = ("conda_env", "container_img", "env_modules", "bench_record", "shadow_dir")
"""What Snakemake's scripts may need that a fork cannot give."""

THREADS = ("OMP", "GOTO", "OPENBLAS", "MKL", "NUMEXPR")
TEMPORARY = ("TMPDIR", "TMP", "TEMPDIR", "TEMP")


class HostGoneError(RuntimeError):
    """The process that runs scripts has ended, so it cannot be known how a script ended."""


class ScriptHost:
    """A process that imports what scripts import and runs each script in a fork.

    Parameters
    ----------
    python : str
        The interpreter.
    """

    def __init__(self, python: str) -> None:
        self._channel, theirs = Pipe()
        with theirs:
            command = [python, str(HOST), str(theirs.fileno())]
            self._process = subprocess.Popen(command, pass_fds=[theirs.fileno()])
        self._lock = threading.Lock()
        self._numbers = itertools.count()
        self._ends: dict[int, Future[int]] = {}
        self.gone = False
        threading.Thread(target=self._listen, daemon=True).start()
        atexit.register(self.close)

    def prepare(
        self,
        scripts: Iterable[str | Path],
        hashed: Iterable[str] = (),
        compiled: Iterable[str] = (),
    ) -> None:
        """Let the host do, when it has nothing else to do, what several scripts would do again.

        Parameters
        ----------
        scripts : iterable of str or Path
            What they import is imported.
        hashed : iterable of str
            Modules of this package, or files, whose code is hashed (`nptcs.provenance.code_hash`).
        compiled : iterable of str
            Modules that compile what they need when they are imported: each is imported in a
            process of its own, next to the scripts.
        """
        tasks = [(IMPORT_IN_FORK, module) for module in compiled]
        tasks += [(IMPORT, str(script)) for script in scripts]
        tasks += [(HASH, module) for module in hashed]
        with suppress(OSError), self._lock:
            for task in tasks:
                self._channel.send((None, task, {}))

    def run(self, script: str, environment: Mapping[str, str]) -> int:
        """Run a script and wait for its end.

        Parameters
        ----------
        script : str
            Path.
        environment : mapping of str to str
            Variables on top of those of this process.

        Returns
        -------
        int
            Its exit code; minus the number of the signal that ended it.

        Raises
        ------
        HostGoneError
            If the host ended first; then it has ended the script as well.
        """
        end: Future[int] = Future()
        with self._lock:
            if self.gone:
                raise HostGoneError
            number = next(self._numbers)
            self._ends[number] = end
            with suppress(OSError):  # then the listener finds the host gone
                self._channel.send((number, script, dict(environment)))
        return end.result()

    def close(self) -> None:
        """Let the host end, and the scripts that it still runs."""
        with suppress(OSError), self._lock:
            self._channel.send(None)
        try:
            self._process.wait(GRACE_S)
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.wait()

    def _listen(self) -> None:
        """Note how scripts end, until the host ends."""
        with suppress(EOFError, OSError):
            while True:
                number, code = self._channel.recv()
                self._ends.pop(number).set_result(code)
        with self._lock:
            self.gone = True
            for end in self._ends.values():
                end.set_exception(HostGoneError())


def host_scripts(script_class: Any, folder: Path, host: ScriptHost) -> None:
    """Run the Python scripts of a folder in a host.

    Parameters
    ----------
    script_class : type
        ``snakemake.script.PythonScript``.
    folder : Path
        Scripts from elsewhere, and those with their own environment, are left to Snakemake.
    host : ScriptHost
    """
    start_interpreter = script_class.execute_script

    def execute_script(script: Any, fname: str, edit: bool = False) -> None:
        if edit or host.gone or not hosted(script, folder):
            start_interpreter(script, fname, edit)
            return
        try:
            code = host.run(fname, environment_of(script))
        except HostGoneError:
            code = 1
        if code:
            raise subprocess.CalledProcessError(code, f"{sys.executable} {fname}")

    script_class.execute_script = execute_script


def hosted(script: Any, folder: Path) -> bool:
    """Tell whether a script of Snakemake may run in a fork."""
    if any(getattr(script, name, None) for name in SPECIAL):
        return False
    file = Path(script.path.get_path_or_uri(secret_free=True))
    return script.is_local and file.resolve().parent == folder.resolve()


def environment_of(script: Any) -> dict[str, str]:
    """Name the variables that Snakemake sets for the interpreter of a script."""
    threads = {f"{library}_NUM_THREADS": str(script.threads) for library in THREADS}
    threads["VECLIB_MAXIMUM_THREADS"] = str(script.threads)
    temporary = script.resources.get("tmpdir")
    return threads | (dict.fromkeys(TEMPORARY, str(temporary)) if temporary else {})
