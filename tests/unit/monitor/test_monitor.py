"""What a person sees of a run: failures first, one line on a terminal, the end with its paths."""

import io
import json
import logging
from types import SimpleNamespace

import pytest
from snakemake_interface_logger_plugins.common import LogEvent

from nptcs.campaign.progress import ProgressWriter, progress_file, read_progress
from nptcs.monitor.handler import RunHandler
from nptcs.monitor.run import Run
from nptcs.monitor.words import closing_lines, error_message, status_line
from nptcs.tables.status import Status

QUIET = SimpleNamespace(
    stdout=False, dryrun=False, verbose=False, printshellcmds=False, nocolor=True, quiet=None,
    debug_dag=False, show_failed_logs=True,
)  # fmt: skip


class Terminal(io.StringIO):
    def isatty(self):
        return True


@pytest.fixture
def handler(monkeypatch, tmp_path):
    monkeypatch.chdir(tmp_path)
    made = RunHandler(QUIET, None)
    made.stream = io.StringIO()
    yield made
    made.ended.set()


def record(message="", level=logging.INFO, **facts):
    made = logging.LogRecord("snakemake", level, "", 0, message, None, None)
    made.__dict__.update(facts)
    return made


def job(jobid, rule, **facts):
    return record(
        event=LogEvent.JOB_INFO,
        jobid=jobid,
        rule_name=rule,
        **{"wildcards": {}, "log": [], **facts},
    )


def case(seconds, status="ok"):
    result = SimpleNamespace(status=Status(status), message="no equilibrium")
    return SimpleNamespace(case_id="plate_001", wall_time_s=seconds, result=result)


def test_the_time_left_comes_from_the_cases_that_ran(tmp_path):
    log = tmp_path / "plate_fe_tyre_1.log"
    writer = ProgressWriter(log, "plate", "fe_tyre", 2)
    writer.case(case(99.0), True, 1, 11)  # known: says nothing about the time
    assert read_progress(log)["left_s"] is None
    writer.written = 0.0
    writer.case(case(4.0), False, 2, 11)
    writer.written = 0.0
    writer.case(case(6.0, "diverged"), False, 3, 11)
    assert read_progress(log) == {
        "study": "plate", "solver": "fe_tyre", "done": 3, "total": 11, "failed": 1,
        "left_s": pytest.approx(8 * 5.0 / 2),
    }  # fmt: skip
    assert log.read_text().splitlines()[-1].endswith("diverged (6.00 s): no equilibrium")


@pytest.mark.parametrize("content", ["", "[1]", '{"study": 1}', "{"])
def test_a_file_that_cannot_be_read_is_no_progress(tmp_path, content):
    log = tmp_path / "a.log"
    progress_file(log).write_text(content)
    assert read_progress(log) is None


def test_one_line_adds_up_the_parts_of_a_study():
    parts = {
        str(n): {
            "study": "plate", "solver": "fe_tyre", "done": n, "total": 20, "failed": 1,
            "left_s": 60.0 * n,
        }
        for n in (5, 9)
    }  # fmt: skip
    run = Run(total=95, done=40, solved={("plate", "fe_tyre"): parts})
    line = status_line(run, 120)
    assert line == "40 of 95 jobs · plate/fe_tyre 14/40, 2 failed, 9 min left"
    assert len(status_line(run, 30)) < 30
    for one in parts.values():
        one["done"] = 20
    assert status_line(run, 120) == "40 of 95 jobs"


def test_snakemakes_chatter_is_suppressed_and_errors_are_not(handler):
    handler.emit(record("Building DAG of jobs..."))
    handler.emit(record("Select jobs to execute..."))
    assert handler.stream.getvalue() == ""
    handler.emit(record("Nothing to be done (all requested files are present)."))
    handler.emit(record("disk quota exceeded", logging.ERROR))
    shown = handler.stream.getvalue().splitlines()
    assert shown == ["Nothing to be done (all requested files are present).", "disk quota exceeded"]


@pytest.mark.parametrize("recorded", [False, True])
def test_results_that_were_copied_here_are_not_believed_in_silence(handler, tmp_path, recorded):
    (tmp_path / "results").mkdir()
    (tmp_path / "results/report.html").touch()
    folder = tmp_path / ".snakemake/metadata"
    folder.mkdir(parents=True)
    if recorded:
        # the name that Snakemake gives it
        (folder / "cmVzdWx0cy9yZXBvcnQuaHRtbA==").touch()
    handler.emit(record("Nothing to be done (all requested files are present)."))
    handler.close()
    shown = handler.stream.getvalue()
    assert "report: results/report.html" in shown
    assert ("no record of how this was made" in shown) != recorded
    assert ("snakemake -j2 --forceall" in shown) != recorded


def test_of_an_error_only_the_users_message_is_left():
    raw = 'WorkflowError in file "/a/workflow/rules/common.smk", line 64:\nno such key\n  File "x"'
    assert error_message(raw) == "no such key"
    assert error_message("RuleException:\nCalledProcessError in file ...") == ""
    assert error_message("Exiting because a job execution failed.") == ""


def test_a_failed_job_is_named_at_once_and_at_the_end(handler, tmp_path):
    log = tmp_path / "T0-1.log"
    log.write_text("a.csv, specimen T0-1: no unit. Remedy: name it\n")
    handler.emit(record(event=LogEvent.RUN_INFO, stats={"total": 3}))
    handler.emit(job(1, "ingest", wildcards={"specimen": "T0-1"}, log=[str(log)]))
    handler.emit(record(event=LogEvent.PROGRESS, done=2, total=3))
    handler.emit(record(level=logging.ERROR, event=LogEvent.JOB_ERROR, jobid=1, rule_name="ingest"))
    assert handler.stream.getvalue() == f"failed: ingest T0-1 (log: {log})\n"
    (tmp_path / "results").mkdir()
    (tmp_path / "results/report.html").touch()
    handler.close()
    end = handler.stream.getvalue()
    assert "2 of 3 jobs" in end
    assert "FAILED ingest T0-1: a.csv, specimen T0-1: no unit. Remedy: name it" in end
    assert "report: results/report.html" in end
    assert "workbook" not in end
    handler.close()
    assert handler.stream.getvalue() == end


def test_a_run_without_jobs_ends_without_a_word(handler):
    handler.close()
    handler.close()
    assert handler.stream.getvalue() == ""


def test_a_terminal_gets_a_line_that_refreshes_and_a_log_does_not(monkeypatch, tmp_path):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("TERM", "xterm")
    monkeypatch.setattr("nptcs.monitor.handler.REFRESH_S", 0.01)
    monkeypatch.setattr("sys.stderr", Terminal())
    shown = RunHandler(QUIET, None)
    progress_file("s.log").write_text(
        json.dumps({"study": "s", "solver": "lca", "done": 1, "total": 2, "failed": 0,
                    "left_s": 3.0})
    )  # fmt: skip
    shown.emit(record(event=LogEvent.RUN_INFO, stats={"total": 3}))
    shown.emit(job(1, "solve", log=["s.log"]))
    for _ in range(500):
        if "s/lca 1/2, 3 s left" in shown.stream.getvalue():
            break
        shown.ended.wait(0.01)
    else:
        pytest.fail(shown.stream.getvalue())
    shown.close()


def test_where_everything_went_well_it_says_done(tmp_path):
    run = Run(total=3, done=3)
    assert closing_lines(run, 12.0, "", pages=[])[0] == "Done: 3 of 3 jobs in 12 s"


def test_a_dry_run_has_snakemakes_own_words(monkeypatch, tmp_path):
    monkeypatch.chdir(tmp_path)
    settings = SimpleNamespace(**{**vars(QUIET), "dryrun": True})
    stream = io.StringIO()
    monkeypatch.setattr("sys.stderr", stream)
    dry = RunHandler(settings, None)
    dry.emit(record("Building DAG of jobs..."))
    dry.close()
    assert "Building DAG of jobs..." in stream.getvalue()
