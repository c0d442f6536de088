"""A solver for the tests: it runs a command that starts another, and neither ends by itself."""

import sys
import tempfile
from pathlib import Path

from nptcs.solvers.contract import Solver, SolverOptions, SolverResult, Status
from nptcs.solvers.external import run_command

SCRIPT = """
import os, subprocess, sys, time
child = subprocess.Popen([sys.executable, "-c", "import time; time.sleep(600)"])
with open(sys.argv[1] + ".part", "w") as stream:
    stream.write(f"{os.getpid()} {child.pid}")
os.replace(sys.argv[1] + ".part", sys.argv[1])
time.sleep(600)
"""


class Options(SolverOptions):
    pids: str = ""


def solve(inputs):
    with tempfile.TemporaryDirectory() as folder:
        run_command([sys.executable, "-c", SCRIPT, inputs.options.pids], Path(folder), 600.0)
    return SolverResult(status=Status.OK)


SOLVER = Solver(
    name="commanding",
    version="1",
    about="runs a command that does not end",
    solve=solve,
    factors=frozenset({"kind"}),
    options=Options,
)
