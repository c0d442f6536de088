"""The command line: help, checks before a run, clear errors."""

import csv
import shutil
from pathlib import Path

import pytest
import yaml

from nptcs.cli import build_parser, main

ROOT = Path(__file__).parents[3]


@pytest.fixture
def project(tmp_path, monkeypatch):
    for name in ("config", "raw_data"):
        shutil.copytree(ROOT / name, tmp_path / name)
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_help_lists_every_command():
    text = build_parser().format_help()
    for command in ("check", "example", "inspect", "new-sheet", "lca", "schema"):
        assert f"\n    {command}" in text


def test_check_says_what_is_planned(project, capsys):
    assert main(["check"]) == 0
    printed = capsys.readouterr().out
    assert "study plate: 63 cases (full_factorial)" in printed
    assert "fe_tyre_paper: known cases are counted once the materials are calibrated" in printed
    assert "study rubber: 15 cases (full_factorial)" in printed


def test_check_names_every_fault_of_the_sheet(project, capsys):
    sheet = project / "raw_data/example/specimens.csv"
    with sheet.open(encoding="utf-8", newline="") as stream:
        rows = list(csv.DictReader(stream))
    rows[0]["thickness_mm"] = ""
    rows[1]["force_file"] = "gone.csv"
    with sheet.open("w", encoding="utf-8", newline="") as stream:
        writer = csv.DictWriter(stream, rows[0])
        writer.writeheader()
        writer.writerows(rows)

    assert main(["check"]) == 1

    faults = capsys.readouterr().err
    assert f"specimens.csv:2, specimen {rows[0]['specimen']}, column 'thickness_mm'" in faults
    assert "gone.csv" in faults


def test_a_faulty_configuration_is_one_clear_line(project, capsys):
    config = yaml.safe_load((project / "config/config.yaml").read_text())
    config["sensitivty"] = config.pop("sensitivity")
    (project / "config/own.yaml").write_text(yaml.safe_dump(config))

    assert main(["check", "config/own.yaml"]) == 2

    message = capsys.readouterr().err
    assert "config/own.yaml: sensitivty: unknown key; did you mean 'sensitivity'?" in message
    assert "Traceback" not in message


def test_a_file_that_is_not_yaml_is_named(project, capsys):
    (project / "broken.yaml").write_text("studies: [")
    assert main(["check", "broken.yaml"]) == 2
    assert "not YAML" in capsys.readouterr().err
