"""A killed case is tried again by the same command; one that a solver gave up on is not."""

import re

SOLVER = """
import os, signal
from pathlib import Path
from nptcs.solvers.contract import Solver, SolverResult

def solve(inputs):
    c = inputs.values["c"]
    if c == 2 and not Path("calm").exists():
        os.kill(os.getpid(), signal.SIGKILL)
    if c == 3:
        raise ValueError("gave up")
    return SolverResult(status="ok", vertical_stiffness_n_per_mm=c, displacement_mm=1.0)

SOLVER = Solver("flaky", "1", solve, frozenset({"c"}), about="a test")
"""
CONFIG = """
studies:
  - name: f
    title: Cases that die
    factors: [{name: c, label: c, unit: "-", levels: [1, 2, 3]}]
    solvers: [flaky]
solvers: {flaky: {module: flaky.py}}
"""
BATCH = "results/5_solve/f/flaky/batch_1.jsonl"


def test_a_killed_case_is_tried_again_and_a_given_up_one_only_on_purpose(unsolved):
    unsolved.path("flaky.py").write_text(SOLVER)
    unsolved.path("config/config.yaml").write_text(CONFIG)

    def run():
        done, solved = unsolved.solved_in_logs(BATCH, config="config/config.yaml")
        assert done.returncode == 0, done.stderr[-3000:]
        found = re.findall(r"^f/flaky \d/3 (f_\d+) (\w+) \((known)?", solved, re.MULTILINE)
        return {case: known or status for case, status, known in found}

    assert run() == {"f_001": "ok", "f_002": "error", "f_003": "error"}
    unsolved.path("calm").touch()
    assert run() == {"f_001": "known", "f_002": "ok", "f_003": "error"}
    assert run() == {}  # what the solver gave up on stays as it is

    assert unsolved.nptcs("retry", "f").returncode == 0
    assert run() == {"f_001": "known", "f_002": "known", "f_003": "error"}
    assert run() == {}
