"""What a change reruns: content counts, dates do not, words only where they are printed."""

import os
import re
import shutil

import pytest
from filelock import FileLock
from increments import CHANGES, CONFIG, changed_copy, plan_all, summary, write_config

from conftest import Project

NAMES = [change.name for change in CHANGES]
SOLVED = re.compile(r"^\w+/\w+ \d+/\d+ \S+ ok \([\d.]+ s", re.MULTILINE)


@pytest.fixture(scope="session")
def grown(finished, tmp_path_factory) -> Project:
    """The finished project with one more study, on tested rubbers and a ply; once for all workers."""
    base = tmp_path_factory.getbasetemp()
    folder = (base.parent if "PYTEST_XDIST_WORKER" in os.environ else base) / "grown" / "copy"
    project = Project(folder)
    with FileLock(folder.parent.with_suffix(".lock")):
        if not folder.exists():
            shutil.copytree(finished.folder, folder, symlinks=True)
            write_config(folder)
            run = project.snakemake(config=CONFIG)
            assert run.returncode == 0, run.stderr[-4000:]
    assert project.path("results/verdict.txt").exists()
    return project


@pytest.fixture(scope="module")
def planned(grown, tmp_path_factory):
    """The plan after each change that needs no run."""
    base = tmp_path_factory.mktemp("increments")
    chosen = [change for change in CHANGES if not change.solves]
    folders = [base / str(number) for number in range(len(chosen))]
    for change, folder in zip(chosen, folders, strict=True):
        changed_copy(grown.folder, folder, change)
    return dict(zip((change.name for change in chosen), plan_all(folders), strict=True))


@pytest.mark.parametrize(
    "change", [change for change in CHANGES if not change.solves], ids=lambda change: change.name
)
def test_a_change_reruns_what_it_decides(planned, change):
    found = planned[change.name]
    assert summary(found["jobs"], found["cases"]) == change.expected(), found["jobs"]


@pytest.mark.parametrize(
    "change",
    [change for change in CHANGES if change.name in ("raw file of a rubber", "raw file of a composite")],
    ids=lambda change: change.name,
)  # fmt: skip
def test_a_changed_material_solves_the_cases_that_rest_on_it(grown, tmp_path, change):
    project = Project(tmp_path / "changed")
    changed_copy(grown.folder, project.folder, change)
    jobs = project.planned(config=CONFIG)
    targets = [
        str(path.relative_to(grown.folder))
        for path in grown.folder.glob("results/5_solve/tested/*/*.jsonl")
    ]
    run = project.snakemake(*targets, config=CONFIG)
    assert run.returncode == 0, run.stderr[-3000:]
    assert summary(jobs, len(SOLVED.findall(run.stderr))) == change.expected()


def test_the_table_of_the_docs_has_every_row(request):
    page = (request.config.rootpath / "docs/runs.md").read_text(encoding="utf-8")
    for change in CHANGES:
        assert change.row() in page, "python benchmarks/increments.py prints the table"
