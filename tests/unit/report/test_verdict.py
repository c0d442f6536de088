"""The verdict, the catalogue and what becomes of old reports."""

import os
import re
from dataclasses import replace
from pathlib import Path

from nptcs.report.stale import set_aside
from nptcs.report.tables.sheets import sheets_of
from nptcs.tables.catalogue import TABLES, result_files
from nptcs.tables.problems import Problems

RULES = Path(__file__).parents[3] / "workflow" / "rules"


def test_a_sound_run(results):
    assert results.verdict() == (
        True,
        "No problems: all 78 cases solved; 2 of 3 specimens used (1 left out by the sheet).",
    )


def test_a_run_with_problems(faulty):
    assert faulty.verdict() == (
        False,
        "2 problems: 77 of 78 cases solved; 1 of 3 specimens used "
        "(1 left out by the sheet, 1 could not be read).",
    )


def test_one_problem_is_enough(faulty):
    one = replace(faulty, tables={**faulty.tables, "problems.csv": faulty.table(Problems)[:1]})
    sound, line = one.verdict()
    assert not sound
    assert line.startswith("1 problem:")


def test_every_rule_of_the_catalogue_exists(results):
    text = "".join(file.read_text("utf-8") for file in RULES.glob("*.smk"))
    # the rules that read specimens are one per batch: ingest_SERIES_NUMBER
    batches = re.findall(r'name:\s+f"([a-z]+)_\{', text)
    rules = {*re.findall(r"^rule (\w+):", text, re.M), *batches, "(input)"}
    named = {rule for sheet in sheets_of(results).values() for rule in sheet.entry.rule.split(", ")}
    assert named <= rules


def test_every_result_table_is_a_sheet(results):
    files = {Path(sheet.entry.file).name for sheet in sheets_of(results).values()}
    expected = {name for name, _, _ in result_files(["plate", "rubber"])}
    assert len(expected) > len(TABLES)
    assert expected <= files


def run_that_failed(tmp_path, report_age, log_age):
    """Make a report and a verdict's log that are older (or newer) than the run's start."""
    started = 1_000_000.0
    report, log = tmp_path / "report.html", tmp_path / "verdict.log"
    for file, age in ((report, report_age), (log, log_age)):
        if age is not None:
            file.write_text("x", encoding="utf-8")
            os.utime(file, (started - age, started - age))
    return set_aside([report, tmp_path / "workbook.xlsx"], log, started), report


def test_a_report_of_an_earlier_run_is_set_aside(tmp_path, capsys):
    renamed, report = run_that_failed(tmp_path, report_age=60, log_age=60)
    assert renamed == [tmp_path / "report.stale.html"]
    assert not report.exists()
    assert renamed[0].read_text(encoding="utf-8") == "x"
    assert "report.stale.html" in capsys.readouterr().err


def test_a_report_that_this_run_judged_stays(tmp_path, capsys):
    renamed, report = run_that_failed(tmp_path, report_age=60, log_age=-5)
    assert not renamed
    assert report.exists()
    assert "lists every problem at its top" in capsys.readouterr().err


def test_a_report_that_this_run_built_stays(tmp_path):
    renamed, report = run_that_failed(tmp_path, report_age=-5, log_age=None)
    assert not renamed
    assert report.exists()
