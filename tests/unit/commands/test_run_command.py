"""``nptcs run`` starts Snakemake with the settings that it is given."""

import shutil
import subprocess
import sys
from pathlib import Path

import pytest
import yaml

from nptcs.cli import build_parser, main
from nptcs.commands.run import snakemake_command, usable_cores

ROOT = Path(__file__).parents[3]


@pytest.fixture
def project(tmp_path, monkeypatch):
    for name in ("config", "raw_data"):
        shutil.copytree(ROOT / name, tmp_path / name)
    (tmp_path / "Snakefile").touch()
    monkeypatch.chdir(tmp_path)
    return tmp_path


def command(*words):
    """Return the arguments that Snakemake gets."""
    python, *rest = snakemake_command(build_parser().parse_args(["run", *words]))
    assert python == sys.executable
    assert rest[:2] == ["-m", "snakemake"]
    return rest[2:]


def test_nothing_given_is_the_whole_study_on_all_cores(project):
    assert command() == [f"-j{usable_cores()}"]


def test_everything_is_passed_through(project):
    given = ["report", "--cores", "3", "--dry-run", "--configfile", "config/joint.yaml"]
    assert command(*given) == [
        "report",
        "-j3",
        "--dry-run",
        "--configfile",
        "config/joint.yaml",
    ]
    assert command("-j1", "--", "report", "--forceall") == ["report", "--forceall", "-j1"]


def larger(project, most_cases):
    """Write a configuration whose study has more cases than a run solves without being asked."""
    content = yaml.safe_load((project / "config/config.yaml").read_text(encoding="utf-8"))
    content["campaign"] = {"most_cases": most_cases}
    (project / "config/config.yaml").write_text(yaml.safe_dump(content), encoding="utf-8")


def test_yes_raises_the_limit_to_the_largest_study(project):
    assert command("--yes", "-j1") == ["-j1"]
    larger(project, 10)
    assert command("--yes", "-j1") == ["-j1", "--config", "campaign={most_cases: 63}"]
    assert command("-j1") == ["-j1"]


def test_without_yes_the_check_names_the_way_to_go_on(project, capsys):
    larger(project, 10)
    assert main(["check"]) == 2
    assert "start the run with 'nptcs run --yes'" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["--cores", "0"], "-j/--cores: must be at least 1, got 0"),
        (["--cores", "all"], "-j/--cores: must be a whole number at least 1, got 'all'"),
        (["--configfile", "gone.yaml"], "--configfile: the file gone.yaml does not exist"),
        (["--project", "gone"], "--project: the folder gone does not exist"),
        (["--project", "config"], "there is no Snakefile in this folder"),
    ],
)
def test_what_cannot_run_is_refused_before_snakemake_starts(project, capsys, words, said):
    assert main(["run", *words]) == 2
    assert said in capsys.readouterr().err


def test_snakemake_reads_the_limit_as_a_number(tmp_path):
    snakefile = "configfile: 'c.yaml'\nrule all:\n    run:\n        print(config)\n"
    (tmp_path / "Snakefile").write_text(snakefile, encoding="utf-8")
    (tmp_path / "c.yaml").write_text("campaign: {most_cases: 10, batches: 2}\n", encoding="utf-8")
    told = "campaign={most_cases: 63}"
    done = subprocess.run(
        [sys.executable, "-m", "snakemake", "-j1", "--config", told],
        cwd=tmp_path,
        capture_output=True,
        text=True,
        check=True,
    )
    assert "'batches': 2" in done.stdout
    assert "63" in done.stdout
