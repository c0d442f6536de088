"""Cases that raise, hang, crash or lie become rows; the others are solved; none is solved twice."""

import os
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from nptcs.campaign.cases import cases_table
from nptcs.campaign.jobs import make_jobs
from nptcs.campaign.record import (
    CaseJob,
    RecordStore,
    read_records,
    read_solver_tables,
    write_records,
)
from nptcs.campaign.runner import run_cases
from nptcs.campaign.tries import ended_from_outside, note_ends, read_tries, tries_file
from nptcs.cli import main
from nptcs.config.solvers.tyre import TyreGeometry
from nptcs.config.studies.study import Study
from nptcs.errors import InputError
from nptcs.provenance import code_hash
from nptcs.tables.io import check
from nptcs.tables.tyres.cases import Cases

SOLVER = Path(__file__).with_name("faulty_solver.py")


def job(kind, other=1.0, **changes):
    values = {
        "study": "s",
        "case_id": f"s_{kind:03d}",
        "solver": "faulty",
        "solver_version": "1",
        "module": str(SOLVER),
        "code": code_hash(str(SOLVER)),
        "values": {"kind": float(kind), "other": other},
        "load_n": 5000.0,
        "tyre": TyreGeometry().model_dump(),
        "ply": None,
        "options": {"timeout_s": 2.0},
        "without_effect": ("timeout_s",),
        "tables": {},
    }
    return CaseJob(**{**values, **changes})


def quiet(record, reused, done, total):
    pass


@pytest.fixture
def store(tmp_path):
    return RecordStore(tmp_path / "records")


def test_each_way_to_fail_is_a_row_and_the_others_are_solved(store):
    kinds = [10, 1, 2, 3, 4, 5, 6, 7, 8, 11, 12]
    records = run_cases([job(kind) for kind in kinds], store, 2, quiet)

    ended = {int(r.values["kind"]): (r.result.status.value, r.result.message) for r in records}
    assert [int(record.values["kind"]) for record in records] == kinds
    assert ended[1][0] == "error"
    assert "RuntimeError: the mesh has folded (faulty_solver.py, line 13)" in ended[1][1]
    assert ended[2][0] == "timeout"
    assert "timeout_s = 2" in ended[2][1]
    assert ended[3] == ("error", "the solver's process was killed by signal SIGKILL")
    # killed from outside and out of memory: tried again by the next run
    again = {int(r.values["kind"]) for r in records if ended_from_outside(r)}
    assert again == {2, 3, 5, 7}
    assert "out of memory" in ended[7][1]
    assert ended[4] == (
        "error",
        "the solver's process ended without a result (exit code 3)",
    )
    assert ended[5] == ("licence", "no token")
    assert ended[6][0] == "error"
    assert "no_such_field" in ended[6][1]
    for kind in (10, 11, 12):
        assert ended[kind] == ("ok", "")
    assert records[0].result.vertical_stiffness_n_per_mm == 201


def test_each_case_has_one_thread_and_the_caller_keeps_its_own(store, monkeypatch):
    monkeypatch.setenv("OPENBLAS_NUM_THREADS", "2")
    (record,) = run_cases([job(10)], store, 1, quiet)
    assert record.result.extra == {"threads": 1.0}
    assert os.environ["OPENBLAS_NUM_THREADS"] == "2"


def test_solved_cases_are_reused_and_failed_ones_tried_again(store):
    jobs = [job(10), job(1), job(11)]
    run_cases(jobs, store, 2, quiet)
    seen = []

    run_cases(jobs, store, 2, lambda record, reused, *_: seen.append((record.case_id, reused)))

    assert sorted(seen) == [("s_001", False), ("s_010", True), ("s_011", True)]


def test_a_record_serves_another_study_with_the_same_case(store):
    run_cases([job(10)], store, 1, quiet)
    reuse = []

    (record,) = run_cases(
        [job(10, study="other", case_id="other_001")],
        store,
        1,
        lambda record, reused, *_: reuse.append(reused),
    )

    assert reuse == [True]
    assert (record.study, record.case_id) == ("other", "other_001")


@pytest.mark.parametrize(
    "change",
    [
        {"values": {"kind": 10.0, "other": 1.0000001}},
        {"load_n": 4000.0},
        {"ply": {"e1_mpa": 128000.0}},
        {"options": {"timeout_s": 2.0, "mesh": 2}},
        {"tables": {"archive": [{"case": 1}]}},
        {"solver_version": "2"},
        {"code": "other"},
        {"tyre": TyreGeometry(spoke_count=61).model_dump()},
    ],
)
def test_whatever_decides_the_result_is_in_the_key(change):
    assert job(10, **change).key != job(10).key


def test_names_and_time_limits_are_not_in_the_key():
    other = job(10, study="t", case_id="t_1", options={"timeout_s": 99.0})
    assert other.key == job(10).key


@pytest.mark.parametrize("content", [b"", b"{", b"\xff\xfe", b'{"status": "ok"}', b"[]"])
def test_an_unreadable_record_is_a_miss(store, content):
    run_cases([job(10)], store, 1, quiet)
    store.path(job(10).key).write_bytes(content)

    reuse = []
    (record,) = run_cases([job(10)], store, 1, lambda record, reused, *_: reuse.append(reused))

    assert reuse == [False]
    assert record.result.status == "ok"
    assert store.read(job(10)) == record


def test_batch_files_keep_every_record(tmp_path, store):
    records = run_cases([job(10), job(1)], store, 2, quiet)
    write_records(tmp_path / "batch.jsonl", records)
    assert read_records([str(tmp_path / "batch.jsonl")]) == records


@pytest.mark.skipif(not Path("/proc").is_dir(), reason="reads the process table of Linux")
def test_tables_of_a_solver_are_rows_of_plain_values(tmp_path):
    path = tmp_path / "archive.csv"
    path.write_bytes(b"# of a paper\ncase,name\r\n1,a\r\n2,b\r\n")
    rows = [{"case": 1, "name": "a"}, {"case": 2, "name": "b"}]
    assert read_solver_tables({"archive": str(path)}) == {"archive": rows}


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (None, "does not exist"),
        (b"case,x\n1,2\n1,2,3\n", "not a CSV table: .*line 3"),
        (b"", "not a CSV table"),
        ("case,µ\n1,2\n".encode("utf-16"), "not a CSV table"),
        (b"case,x\n", "no rows"),
    ],
    ids=["missing", "ragged", "empty", "not UTF-8", "header alone"],
)
def test_a_faulty_table_of_a_solver_is_named_with_its_file(tmp_path, content, message):
    path = tmp_path / "archive.csv"
    if content is not None:
        path.write_bytes(content)
    with pytest.raises(InputError, match=message) as refusal:
        read_solver_tables({"archive": str(path)})
    assert (refusal.value.file, refusal.value.column) == (str(path), "archive")
    assert refusal.value.remedy


def test_no_case_outlives_a_killed_campaign(tmp_path):
    code = f"""
import sys
sys.path[:0] = {[str(Path(__file__).parent), *sys.path]!r}
from test_campaign import job, quiet
from nptcs.campaign.record import RecordStore
from nptcs.campaign.runner import run_cases
slow = job(2, options={{"timeout_s": 300.0}})
print("ready", flush=True)
run_cases([slow], RecordStore({str(tmp_path)!r}), 1, quiet)
"""
    script = tmp_path / "campaign_to_kill.py"
    script.write_text(code)
    campaign = subprocess.Popen([sys.executable, str(script)], stdout=subprocess.PIPE)
    assert campaign.stdout.readline() == b"ready\n"
    deadline = time.monotonic() + 30
    while len(family := descendants(campaign.pid)) < 2 and time.monotonic() < deadline:
        time.sleep(0.05)
    time.sleep(0.5)
    family = descendants(campaign.pid)
    assert len(family) >= 2

    campaign.kill()
    campaign.wait()
    campaign.stdout.close()

    deadline = time.monotonic() + 30
    while any(alive(pid) for pid in family) and time.monotonic() < deadline:
        time.sleep(0.05)
    assert not [pid for pid in family if alive(pid)]


def descendants(pid):
    children = Path(f"/proc/{pid}/task/{pid}/children").read_text().split()
    return [int(c) for c in children] + [d for c in children for d in descendants(int(c))]


def alive(pid):
    try:
        os.kill(pid, 0)
        return ") Z" not in Path(f"/proc/{pid}/stat").read_text()
    except (ProcessLookupError, FileNotFoundError):
        return False


SPOKES = """
from nptcs.solvers.contract import SPOKE_RESPONSES, Solver, SolverResult

def solve(inputs):
    loaded = inputs.load_n == inputs.load_n  # false for NaN
    responses = dict.fromkeys(SPOKE_RESPONSES, 1.0)
    return SolverResult(status="ok", extra={"load_is_a_number": float(loaded), **responses})

SOLVER = Solver("spokes", "1", solve, frozenset({"c"}), about="a test", loads_tyre=False)
"""


def test_a_solver_of_spokes_is_handed_no_load_and_solves_once_for_all_loads(tmp_path, store):
    module = tmp_path / "spokes.py"
    module.write_text(SPOKES)
    design = pd.DataFrame({"case_id": ["s_001"], "case": [1], "c": [1.0]})
    factor = {"name": "c", "label": "c", "unit": "-", "levels": [1, 2]}
    light, heavy = (
        make_jobs(
            Study(name="s", title="s", factors=[factor], solvers=["spokes"], load_n=load_n),
            "spokes",
            {"module": str(module)},
            TyreGeometry(),
            design,
            None,
        )[0]
        for load_n in (3000.0, 5000.0)
    )
    assert light.load_n is None
    assert light.key == heavy.key
    (record,) = run_cases([light], store, 1, quiet)
    assert record.result.extra["load_is_a_number"] == 0.0
    table = check(cases_table([record]), Cases, "cases")
    assert np.isnan(table["load_n"].iloc[0])


def test_a_solver_that_leaves_out_what_its_kind_gives_has_failed(tmp_path, store):
    module = tmp_path / "half.py"
    lines = SPOKES.replace("**responses", "'tension_stiffness_n_per_mm': 30.0")
    for text, missing in (
        (lines, "compression_stiffness_n_per_mm"),
        (lines.replace("loads_tyre=False", "loads_tyre=True"), "vertical_stiffness_n_per_mm"),
    ):
        module.write_text(text)
        (record,) = run_cases([job(10, module=str(module), code=missing)], store, 1, quiet)
        assert record.result.status == "error"
        assert missing in record.result.message


def test_a_neutral_line_is_carried_through_process_store_and_batch_file(tmp_path, store):
    module = tmp_path / "shaped.py"
    module.write_text(
        "from nptcs.solvers.contract import Solver, SolverResult, neutral_line_columns\n"
        "def solve(inputs):\n"
        "    line = neutral_line_columns([0, 90], [-1, 2], [0, 1])\n"
        "    stiffness = {'vertical_stiffness_n_per_mm': 1.0, 'displacement_mm': 1.0}\n"
        "    return SolverResult(status='ok', neutral_line=line, **stiffness)\n"
        "SOLVER = Solver('shaped', '1', solve, frozenset(), about='a test')\n"
    )
    (record,) = run_cases([job(10, module=str(module))], store, 1, quiet)
    write_records(tmp_path / "batch.jsonl", [record])
    wanted = {"theta_deg": [0.0, 90.0], "radial_mm": [-1.0, 2.0], "tangential_mm": [0.0, 1.0]}
    assert read_records([str(tmp_path / "batch.jsonl")])[0].result.neutral_line == wanted
    assert store.read(job(10, module=str(module))).result.neutral_line == wanted


def test_only_what_ended_from_outside_is_counted_for_another_try(tmp_path, store):
    gave_up, no_licence, solved = run_cases([job(1), job(5), job(10)], store, 2, quiet)
    batch = tmp_path / "batch_1.jsonl"
    note_ends(batch, [gave_up, solved])
    assert read_tries(batch) == 0
    note_ends(batch, [no_licence, gave_up])
    note_ends(batch, [no_licence])
    assert read_tries(batch) == 2
    tries_file(batch).write_bytes(b"\xff")
    assert read_tries(batch) == 0


def test_retry_marks_the_batches_with_failed_cases(tmp_path, store, capsys):
    records = run_cases([job(1), job(10)], store, 2, quiet)
    folder = tmp_path / "results/5_solve/s/faulty"
    write_records(folder / "batch_1.jsonl", records)
    write_records(folder / "batch_2.jsonl", records[1:])
    assert main(["retry", "--results", str(tmp_path / "results")]) == 0
    assert "solves again: 1" in capsys.readouterr().out
    assert [read_tries(folder / f"batch_{n}.jsonl") for n in (1, 2)] == [1, 0]
    assert main(["retry", "unknown", "--results", str(tmp_path / "results")]) == 2
    assert "name one of s" in capsys.readouterr().err


def test_columns_of_unequal_length_are_an_error_of_their_case(tmp_path, store):
    module = tmp_path / "ragged.py"
    module.write_text(
        "from nptcs.solvers.contract import Solver, SolverResult\n"
        "def solve(inputs):\n"
        "    return SolverResult(status='ok', neutral_line={'a': [1.0], 'b': []})\n"
        "SOLVER = Solver('ragged', '1', solve, frozenset(), about='a test')\n"
    )
    (record,) = run_cases([job(10, module=str(module))], store, 1, quiet)
    assert record.result.status == "error"
    assert "equally long" in record.result.message
