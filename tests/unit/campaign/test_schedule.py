"""Cores, licence tokens and cases side by side; commands that end with their case."""

import os
import subprocess
import sys
import time
from pathlib import Path

import pytest

from nptcs.campaign.record import CaseJob, RecordStore
from nptcs.campaign.runner import run_cases
from nptcs.campaign.schedule import batch_cores, batch_tokens, cases_side_by_side
from nptcs.config.solvers.tyre import TyreGeometry
from nptcs.errors import InputError
from nptcs.provenance import code_hash
from nptcs.solvers.abaqus import AbaqusOptions
from nptcs.solvers.contract import SolverOptions

SOLVER = Path(__file__).with_name("commanding_solver.py")
linux = pytest.mark.skipif(not Path("/proc").is_dir(), reason="reads the process table of Linux")


def test_a_solver_without_licence_takes_the_cores_that_it_gets():
    plain = SolverOptions()
    assert batch_cores(2, plain, cases=100) == 2
    assert batch_tokens(2, plain) == 0
    assert cases_side_by_side(2, 0, plain) == 2


@pytest.mark.parametrize(
    ("cpus", "per_batch", "cores", "tokens"), [(1, 2, 2, 10), (2, 5, 5, 12), (4, 2, 4, 8)]
)
def test_a_batch_asks_for_the_tokens_of_all_its_cases(cpus, per_batch, cores, tokens):
    options = AbaqusOptions(cpus=cpus)
    assert batch_cores(per_batch, options, cases=1) == cores
    assert batch_tokens(cores, options) == tokens


@pytest.mark.parametrize(("cases", "cores"), [(1, 1), (20, 1), (21, 2), (63, 4), (1000, 4)])
def test_a_batch_of_cheap_cases_leaves_cores_to_others(cases, cores):
    assert batch_cores(4, SolverOptions(case_s=0.25), cases) == cores


def test_a_case_wider_than_j_asks_for_its_own_tokens():
    assert batch_tokens(2, AbaqusOptions(cpus=4)) == 8


@pytest.mark.parametrize(
    ("cores", "tokens", "cases"), [(8, 40, 8), (8, 12, 2), (8, 14, 2), (8, 5, 1), (1, 40, 1)]
)
def test_tokens_that_were_granted_limit_the_cases(cores, tokens, cases):
    assert cases_side_by_side(cores, tokens, AbaqusOptions()) == cases


def test_a_licence_that_is_not_counted_leaves_the_cores():
    assert cases_side_by_side(8, 0, AbaqusOptions(licence_tokens=0, cpus=2)) == 4


@pytest.mark.parametrize(
    ("cores", "tokens", "message"), [(8, 4, "5 licence tokens"), (2, 40, "4 cores")]
)
def test_too_little_for_one_case_is_refused(cores, tokens, message):
    options = AbaqusOptions(cpus=1 if cores == 8 else 4)
    with pytest.raises(InputError, match=message):
        cases_side_by_side(cores, tokens, options)


def job(pids, timeout_s):
    return CaseJob(
        study="s",
        case_id="s_001",
        solver="commanding",
        solver_version="1",
        module=str(SOLVER),
        code=code_hash(str(SOLVER)),
        values={"kind": 1.0},
        load_n=5000.0,
        tyre=TyreGeometry().model_dump(),
        ply=None,
        options={"timeout_s": timeout_s, "pids": str(pids)},
        without_effect=("timeout_s",),
        tables={},
    )


@linux
def test_a_case_out_of_time_takes_its_commands_with_it(tmp_path):
    (record,) = run_cases(
        [job(tmp_path / "pids", 6.0)], RecordStore(tmp_path / "records"), 1, lambda *_: None
    )
    assert record.result.status == "timeout"
    assert all_gone(tmp_path / "pids")


@linux
def test_no_command_outlives_a_killed_campaign(tmp_path):
    code = f"""
import sys
sys.path[:0] = {[str(Path(__file__).parent), *sys.path]!r}
from test_schedule import job
from nptcs.campaign.record import RecordStore
from nptcs.campaign.runner import run_cases
run_cases([job({str(tmp_path / "pids")!r}, 300.0)], RecordStore({str(tmp_path)!r}), 1, print)
"""
    script = tmp_path / "campaign_to_kill.py"
    script.write_text(code)
    campaign = subprocess.Popen([sys.executable, str(script)])
    deadline = time.monotonic() + 60
    while not (tmp_path / "pids").exists() and time.monotonic() < deadline:
        time.sleep(0.05)
    campaign.kill()
    campaign.wait()
    assert all_gone(tmp_path / "pids")


def all_gone(file):
    """Whether the processes whose numbers are in a file are gone within ten seconds."""
    left = [int(word) for word in file.read_text().split()]
    assert len(left) == 2
    deadline = time.monotonic() + 10
    while left and time.monotonic() < deadline:
        left = [pid for pid in left if alive(pid)]
        time.sleep(0.05)
    return not left


def alive(pid):
    try:
        os.kill(pid, 0)
        return ") Z" not in Path(f"/proc/{pid}/stat").read_text()
    except (ProcessLookupError, FileNotFoundError):
        return False
