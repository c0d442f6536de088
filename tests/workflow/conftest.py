"""A copy of the whole project in which the pipeline has run once, and copies of that copy."""

from __future__ import annotations

import csv
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from filelock import FileLock

ROOT = Path(__file__).parents[2]
SHEET = "raw_data/example/specimens.csv"
SERIES = {  # specimens taken from each series of the example
    "cfrp_tension_0": 3,
    "cfrp_tension_90": 3,
    "cfrp_shear_45": 3,
    "rubber_75A_rubber_tension": 2,
    "rubber_88A_rubber_tension": 2,
}


class Project:
    """A project folder and what happens in it."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder

    def path(self, name: str) -> Path:
        return self.folder / name

    def snakemake(self, *arguments: str, config: str = "config/small.yaml"):
        """Run Snakemake; the copy's own package is the one that counts."""
        return self.run("snakemake", "-j2", *arguments, "--configfile", config)

    def nptcs(self, *arguments: str):
        """Run a command of the package."""
        return self.run("nptcs.cli", *arguments)

    def run(self, module: str, *arguments: str):
        """Run a module of Python in the folder of the project."""
        environment = {
            **os.environ,
            "PYTHONPATH": str(self.folder / "workflow" / "src"),
            "OPENBLAS_NUM_THREADS": "1",
        }
        command = [sys.executable, "-m", module, *arguments]
        return subprocess.run(
            command,
            cwd=self.folder,
            env=environment,
            capture_output=True,
            text=True,
            check=False,
        )

    def solved_in_logs(self, *arguments: str, config: str = "config/small.yaml"):
        """Run, and return the run and what the logs of its solve jobs say."""
        logs = self.path("results/logs/solve")
        shutil.rmtree(logs, ignore_errors=True)
        run = self.snakemake(*arguments, config=config)
        return run, "".join(log.read_text("utf-8") for log in sorted(logs.glob("*.log")))

    def planned(self, **options) -> dict[str, int]:
        """Return how many jobs of each rule a run would do now."""
        run = self.snakemake("-n", **options)
        assert run.returncode == 0, run.stderr
        jobs = re.findall(r"^(?:local)?rule (\w+):$", run.stdout + run.stderr, re.MULTILINE)
        return {name: jobs.count(name) for name in jobs}

    def edit(self, name: str, old: str, new: str) -> None:
        text = self.path(name).read_text(encoding="utf-8")
        assert old in text, f"{old!r} is not in {name}"
        self.path(name).write_text(text.replace(old, new, 1), encoding="utf-8")

    def read_sheet(self) -> tuple[list[dict[str, str]], list[str]]:
        with self.path(SHEET).open(encoding="utf-8", newline="") as stream:
            reader = csv.DictReader(stream)
            return list(reader), list(reader.fieldnames or [])

    def write_sheet(self, columns: list[str], rows: list[dict[str, str]]) -> None:
        with self.path(SHEET).open("w", encoding="utf-8", newline="") as stream:
            writer = csv.DictWriter(stream, columns, lineterminator="\n")
            writer.writeheader()
            writer.writerows(rows)

    def rows(self, table: str) -> list[dict[str, str]]:
        with self.path(f"results/tables/{table}").open(encoding="utf-8", newline="") as stream:
            return list(csv.DictReader(stream))


@pytest.fixture(scope="session")
def finished(tmp_path_factory) -> Project:
    """A small copy of the project in which the pipeline has run once, for all workers.

    xdist gives each worker its own folder inside that of the whole session.
    """
    base = tmp_path_factory.getbasetemp()
    folder = (base.parent if "PYTEST_XDIST_WORKER" in os.environ else base) / "project" / "copy"
    with FileLock(folder.parent.with_suffix(".lock")):
        if not folder.exists():
            run_once(folder)
    project = Project(folder)
    assert project.path("results/verdict.txt").exists(), "the run failed in another worker"
    return project


@pytest.fixture
def unsolved(tmp_path) -> Project:
    """A copy of the project without results."""
    folder = tmp_path / "unsolved"
    copy_project(folder)
    return Project(folder)


def copy_project(folder: Path) -> None:
    """Copy what a run needs."""
    folder.mkdir(parents=True)
    parts = ("Snakefile", "config", "profiles", "raw_data", "tests", "workflow")
    for part in parts:
        source = ROOT / part
        if source.is_dir():
            ignore = shutil.ignore_patterns("__pycache__", "*.egg-info")
            shutil.copytree(source, folder / part, ignore=ignore)
        else:
            shutil.copy2(source, folder / part)


def run_once(folder: Path) -> None:
    """Copy the project and run the small configuration."""
    copy_project(folder)
    project = Project(folder)
    shorten_sheet(project)
    run = project.snakemake()
    assert run.returncode == 0, run.stderr[-6000:]


@pytest.fixture
def project(finished, tmp_path) -> Project:
    """A copy of the finished project, free to be changed."""
    folder = tmp_path / "copy"
    shutil.copytree(finished.folder, folder, symlinks=True)
    return Project(folder)


def shorten_sheet(project: Project) -> None:
    """Keep a few specimens of some series, and only their files."""
    from nptcs.tables.laboratory.specimens import read_sheet

    sheet = project.path(SHEET)
    specimens, errors = read_sheet(sheet)
    assert not errors
    left = dict(SERIES)
    kept = []
    for specimen in specimens:
        if specimen.include and left.get(specimen.series, 0):
            left[specimen.series] -= 1
            kept.append(specimen)
    assert not any(left.values()), f"the example lacks specimens of {left}"
    names = {specimen.specimen for specimen in kept}
    rows, columns = project.read_sheet()
    project.write_sheet(columns, [row for row in rows if row["specimen"] in names])
    files = {sheet.parent / file for specimen in kept for file in specimen.files}
    for path in sheet.parent.rglob("*"):
        if path.is_file() and path not in {*files, sheet, sheet.parent / "README.md"}:
            path.rename(path.with_name(path.name + ".unused"))
