"""What a batch requests from a queue grows with its cases, its attempt and its solver."""

import os
import subprocess
import sys

import pytest
from hypothesis import given
from hypothesis import strategies as st

from nptcs.campaign.queue import batch_count, batch_memory_mb, batch_minutes, licence_request
from nptcs.config.root import Campaign
from nptcs.solvers.contract import SolverOptions
from nptcs.solvers.registry import MODULES, load_solver
from nptcs.threads import VARIABLES


@given(
    cases=st.integers(1, 5000),
    minutes=st.floats(0.01, 1000.0),
    case_s=st.floats(0.01, 1e4),
    cores=st.integers(1, 64),
)
def test_no_batch_is_empty_and_none_takes_longer_than_asked(cases, minutes, case_s, cores):
    options = SolverOptions(case_s=case_s)
    campaign = Campaign(minutes_per_batch=minutes, cores_per_batch=cores)
    batches = batch_count(cases, campaign, options)
    assert 1 <= batches <= cases
    of_one = -(-cases // batches)
    if batches < cases:  # rounding up to whole cases may add one round
        assert (of_one - 1) * case_s / cores / 60.0 <= minutes * (1 + 1e-9)


@given(cases=st.integers(1, 500), batches=st.integers(1, 20), cores=st.integers(1, 16))
def test_the_time_suffices_for_its_cases_and_grows_with_each_attempt(cases, batches, cores):
    options = SolverOptions(case_s=20.0, timeout_s=100.0)
    first, second = (batch_minutes(cases, batches, cores, options, attempt) for attempt in (1, 2))
    assert 60 * first >= cases / batches * 20.0 / cores + 100.0
    assert second >= first
    rounds = cases / batches / cores
    assert second > first or rounds < 3  # less than a minute more


def test_memory_grows_with_the_cases_side_by_side_and_with_each_attempt():
    options = SolverOptions(case_memory_mb=1000.0)
    assert batch_memory_mb(4, options) - batch_memory_mb(1, options) == 3000
    assert batch_memory_mb(1, options, 2) - batch_memory_mb(1, options) == 1000


def test_a_case_of_several_cores_counts_once():
    options = load_solver(MODULES["abaqus"]).options(cpus=4, case_memory_mb=5000.0)
    assert batch_memory_mb(4, options) == 5800
    assert batch_memory_mb(8, options) == 10800


@pytest.mark.parametrize("tokens", [0, 5])
def test_licences_are_requested_only_by_name(tokens):
    assert licence_request(tokens, "") == ""
    assert licence_request(tokens, "abaqus") == ("--licenses=abaqus:5" if tokens else "")


@pytest.mark.parametrize("given_value", [None, "3"])
def test_a_command_runs_on_one_thread_unless_told_otherwise(given_value):
    environment = {k: v for k, v in os.environ.items() if k not in VARIABLES}
    environment["PYTHONPATH"] = os.pathsep.join(sys.path)
    if given_value:
        environment["OMP_NUM_THREADS"] = given_value
    code = (
        "import os, sys; from nptcs.cli import main\n"
        "try: main(['--version'])\n"
        "except SystemExit: pass\n"
        "assert 'numpy' not in sys.modules, 'the limit would come too late'\n"
        f"print([os.environ[name] for name in {VARIABLES}])"
    )
    done = subprocess.run(
        [sys.executable, "-c", code], env=environment, capture_output=True, text=True, check=True
    )
    assert done.stdout.splitlines()[-1] == str([given_value or "1", "1", "1", "1"])
