"""What a change reruns: content counts, dates do not, words only where they are printed."""

import json
import os
import shutil

import pytest
from filelock import FileLock
from increments import (
    CHANGES,
    CONFIG,
    changed_copy,
    plan_all,
    run_change,
    summary,
    table,
    write_config,
)

from conftest import ROOT, Project

NAMES = [change.name for change in CHANGES]


@pytest.fixture(scope="session")
def grown(finished, tmp_path_factory) -> Project:
    """The finished project with one more study, on tested rubbers and a ply, once for all."""
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


@pytest.fixture(scope="session")
def planned(grown):
    """The plan after each change, made once for all test processes."""
    base = grown.folder.parent
    plans = base / "plans.json"
    with FileLock(base / "plans.lock"):
        if not plans.exists():
            folders = [base / str(number) for number in range(len(CHANGES))]
            for change, folder in zip(CHANGES, folders, strict=True):
                changed_copy(grown.folder, folder, change)
            plans.write_text(json.dumps(plan_all(folders)), encoding="utf-8")
    return dict(zip(NAMES, json.loads(plans.read_text("utf-8")), strict=True))


@pytest.mark.parametrize("change", CHANGES, ids=lambda change: change.name)
def test_a_change_reruns_what_it_decides(planned, change):
    plan = planned[change.name]
    found = summary(plan["jobs"], plan["cases"])
    if change.solves:  # which cases are new is known once the material is calibrated
        del found["cases"]
        assert found == change.expected_jobs(), plan["jobs"]
    else:
        assert found == change.expected(), plan["jobs"]


RUN = ("specimen of a rubber: include → no", "raw file of a composite, the same numbers")
"""Changes of materials that the test makes; ``benchmarks/increments.py`` makes all of them."""


@pytest.mark.parametrize("name", RUN)
def test_a_changed_material_solves_the_cases_that_depend_on_it(grown, tmp_path, name):
    change = CHANGES[NAMES.index(name)]
    folder = tmp_path / "changed"
    changed_copy(grown.folder, folder, change)
    assert summary(*run_change(folder)) == change.expected()


def test_the_docs_contain_exactly_this_table():
    page = (ROOT / "docs/runs.md").read_text(encoding="utf-8")
    assert table() in page, "python benchmarks/increments.py prints the table"
