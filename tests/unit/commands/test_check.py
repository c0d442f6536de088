"""``nptcs check`` refuses each mistake that would show only after hours of solving."""

import csv
import shutil
from pathlib import Path

import pytest
import yaml

from nptcs.cli import main

ROOT = Path(__file__).parents[3]
SHEET = "raw_data/example/specimens.csv"
ARCHIVE = {"archive": "raw_data/published/table7_rubber_doe.csv"}


@pytest.fixture(scope="module")
def inputs(tmp_path_factory):
    """The example's sheet, its files and the published tables."""
    folder = tmp_path_factory.mktemp("inputs")
    for name in ("config", "raw_data"):
        shutil.copytree(ROOT / name, folder / name)
    return folder


@pytest.fixture
def project(inputs, monkeypatch):
    monkeypatch.chdir(inputs)
    before = (inputs / SHEET).read_bytes()
    yield inputs
    (inputs / SHEET).write_bytes(before)


def factor(name, *levels):
    return {"name": name, "label": name, "unit": "-", "levels": list(levels)}


PLATES = {"spacing_mm": 15, "thickness_mm": 1.8, "angle_deg": 45}
RUBBERS = [factor("shear_band_c10_mpa", 4, 5, 6), factor("spoke_c10_mpa", 1, 3, 5)]
TERMS = ["1", "shear_band_c10_mpa", "spoke_c10_mpa"]


def study(**changes):
    base = {"name": "own", "title": "t", "factors": RUBBERS, "solvers": ["lca"], "terms": TERMS}
    return {**base, **changes}


def in_sheet(**values):
    """Return an edit of all composite specimens of the sheet."""

    def edit(project):
        with (project / SHEET).open(encoding="utf-8", newline="") as stream:
            rows = list(csv.DictReader(stream))
        for row in rows:
            if row["material"] == "cfrp":
                row.update(values)
        with (project / SHEET).open("w", encoding="utf-8", newline="") as stream:
            writer = csv.DictWriter(stream, rows[0], lineterminator="\n")
            writer.writeheader()
            writer.writerows(rows)

    return edit


def another_composite(project):
    """Add a second composite with the tests of the first."""
    with (project / SHEET).open(encoding="utf-8", newline="") as stream:
        rows = list(csv.DictReader(stream))
    more = [
        row | {"material": "gfrp", "specimen": f"G-{row['specimen']}"}
        for row in rows
        if row["material"] == "cfrp"
    ]
    with (project / SHEET).open("w", encoding="utf-8", newline="") as stream:
        writer = csv.DictWriter(stream, rows[0], lineterminator="\n")
        writer.writeheader()
        writer.writerows([*rows, *more])


FE = {"solvers": ["fe_tyre"], "fixed": PLATES}
MISTAKES = {
    "aliased terms": (study(terms=[*TERMS, "spoke_c10_mpa^2", "spoke_c10_mpa^3"]), None, "aliased"),
    "factor that a solver does not use": (
        study(factors=[*RUBBERS, factor("spacing_mm", 10, 15)]), None, "does not use spacing_mm"),
    "factor that a solver rounds": (
        study(**FE | {"factors": [factor("spacing_mm", 14.05, 15, 20)], "terms": [], "fixed": {
            "thickness_mm": 1.8, "angle_deg": 45, "shear_band_c10_mpa": 5, "spoke_c10_mpa": 1}}),
        None, "spacing_mm 14.05 and 15 are both"),
    "load that the archive does not have": (
        study(solvers=["published"], load_n=4000, solver_options={"published": ARCHIVE}),
        None, "holds results at 5000 N, not at 4000 N"),
    "name that clashes": (study(name="records"), None, "this name is reserved"),
    "name that is too long": (study(), in_sheet(material="c" + "0a1b2c" * 30), "too long"),
    "several composites": (study(**FE), another_composite, "the sheet has 2"),
    "unknown ply": (study(**FE, ply="gfrp"), None, "names a ply that the sheet does not have"),
    "unknown rubber": (
        study(fixed={}, factors=[RUBBERS[0], factor("spoke_c10_mpa", {"rubber": "rubber_7"}, 3.0)]),
        None, "names rubber rubber_7"),
    "missing calibration cases": (
        study(solvers=["published", "lca"], solver_options={"published": ARCHIVE},
              factors=[factor("shear_band_c10_mpa", 4, 9), RUBBERS[1]],
              calibration_cases={"lca": [6]}),
        None, "calibration case 6 of solver 'lca' has no published result"),
}  # fmt: skip


@pytest.mark.parametrize("mistake", MISTAKES)
def test_a_mistake_is_refused(project, capsys, mistake):
    changed, edit, words = MISTAKES[mistake]
    content = yaml.safe_load((ROOT / "config/config.yaml").read_text(encoding="utf-8"))
    (project / "own.yaml").write_text(yaml.safe_dump({**content, "studies": [changed]}))
    if edit is not None:
        edit(project)
    assert main(["check", "own.yaml"]) in (1, 2)
    said = capsys.readouterr()
    assert words in said.err
    assert "Remedy: " in said.err


def test_without_a_mistake_the_plan_is_printed(project, capsys):
    content = yaml.safe_load((ROOT / "config/config.yaml").read_text(encoding="utf-8"))
    (project / "own.yaml").write_text(yaml.safe_dump({**content, "studies": [study()]}))
    assert main(["check", "own.yaml"]) == 0
    said = capsys.readouterr().out
    assert "study own: 9 cases (full_factorial) by lca" in said
    assert "  lca: 0 known, 9 to solve; about" in said
    assert "MB are free" in said
