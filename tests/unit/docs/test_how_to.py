"""The tutorial and each how-to page work when followed to the letter, in a copy of the project.

The study that the tutorial leaves behind is then the one on which the commands of the other pages
are run, as they are shown: `small_tree.shorten` puts it, and one of rubbers, in the place of the
default study. They run in the order of this file.
"""

import importlib.util
import re
import shutil
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[3]
DOCS = ROOT / "docs"
TUTORIAL = DOCS / "tutorial.md"
SAYS_SO = "is run by `tests/unit/docs/test_how_to.py`"
PAGES = [
    page
    for page in sorted(DOCS.rglob("*.md"))
    if SAYS_SO in " ".join(page.read_text("utf-8").split())
]
LOGO = (
    '<svg xmlns="http://www.w3.org/2000/svg" width="40" height="20"><path d="M0 0h40v20z"/></svg>'
)


def load(name):
    spec = importlib.util.spec_from_file_location(
        f"{name}_of_docs", Path(__file__).with_name(f"{name}.py")
    )
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


pages = load("pages")
small_tree = load("small_tree")


def copy_project(folder):
    leave = shutil.ignore_patterns("__pycache__", "*.egg-info")
    for name in ("config", "docs", "profiles", "raw_data", "workflow"):
        shutil.copytree(ROOT / name, folder / name, ignore=leave)
    return folder


@pytest.mark.parametrize("page", [p for p in PAGES if p != TUTORIAL], ids=lambda page: page.stem)
def test_the_page_can_be_followed(page, tmp_path):
    pages.follow(page, copy_project(tmp_path))


def test_pages_that_say_so_are_followed():
    assert {"tutorial", "add-a-factor", "add-a-result-table"} <= {page.stem for page in PAGES}


@pytest.fixture(scope="module")
def april(tmp_path_factory):
    """The folder in which the tutorial was followed; next to it a copy, `march`."""
    base = tmp_path_factory.mktemp("followed")
    tree = copy_project(base / "april")
    pages.follow(TUTORIAL, tree)
    shutil.copytree(tree, base / "march")
    small_tree.complete(tree)
    return tree


def shell(tree, *lines, **options):
    return small_tree.shell(list(lines), tree, **options)


def test_the_tutorial_can_be_followed(april):
    assert (april / "study.zip").is_file()


def test_a_machine_is_set_up_without_fetching_anything(april):
    printed = shell(april, "make setup", ". .venv/bin/activate", "command -v nptcs")
    assert printed.splitlines()[-1] == str(april / ".venv/bin/nptcs")
    here = shell(
        april,
        ". .venv/bin/activate",
        "pip install -c constraints.txt 'nptcs[slurm]'",
        PIP_NO_DEPS="1",  # the plug-in would have to be fetched
        PYTHONPATH="",
    )
    assert "already satisfied: nptcs[slurm]" in here
    assert "does not provide the extra" not in here
    shell(april, "pip install snakemake-executor-plugin-cluster-generic")
    shell(april, "pre-commit install")
    assert (april / ".git/hooks/pre-commit").is_file()
    assert "7 passed" in shell(april, "make test")


def test_a_file_and_a_sheet_as_on_the_page_of_lab_data(april):
    shell(
        april,
        "nptcs inspect raw_data/my_lab/T0-1_wdw.txt --write-profile config/formats/my-machine.yaml",
    )
    profile = april / "config/formats/my-machine.yaml"
    assert profile.is_file()
    profile.unlink()  # else two profiles fit that machine's files
    sheet = april / "raw_data/my_lab/specimens.csv"
    before = sheet.read_text("utf-8")
    shell(
        april,
        "nptcs new-sheet raw_data/my_lab --fill 'T90: test=tension material=cfrp' --fill "
        "'S45: test=shear material=cfrp orientation_deg=45'",
    )
    assert sheet.read_text("utf-8") == before  # the tutorial has filled it in


def test_a_queue_solves_a_new_study(april):
    """A stand-in for `sbatch` gets the jobs that solve; the rest runs here."""
    small_tree.shorten(april)
    plan = shell(april, "nptcs run --dry-run")
    assert re.search(r"^solve +2$", plan, re.MULTILINE)
    shell(
        april,
        "snakemake --executor cluster-generic -j4 --latency-wait 30 --cluster-generic-submit-cmd "
        "'sbatch --parsable --cpus-per-task={threads} --mem={resources.mem_mb} "
        "--time={resources.runtime} --output=results/logs/slurm_%j.log' "
        "--cluster-generic-cancel-cmd scancel",
    )
    submitted = small_tree.submitted(april)
    assert len(submitted) == 3  # the cases of two solvers and the decisions
    assert all(re.search(r"--mem=\d+ --time=\d+ ", line) for line in submitted)
    shutil.rmtree(april / "jobs")


def test_slurm_solves_a_batch_and_retries_it_with_more_memory(april):
    """Stand-ins for the commands of Slurm get the jobs; the first one runs out of memory."""
    shutil.rmtree(april / "results/5_solve/rubber/lca")
    (april / "results/tables/cases.csv").unlink()
    profile = april / "profiles/slurm/config.yaml"
    often = profile.read_text("utf-8").replace("status-checks: 15", "status-checks: 2")
    profile.write_text(often, encoding="utf-8")
    printed = shell(
        april, "snakemake --workflow-profile profiles/slurm", STAND_IN_OUT_OF_MEMORY="1"
    )
    assert "status is: 'OUT_OF_MEMORY'" in printed
    submitted = small_tree.submitted(april)
    rules = [re.search(r"--comment (\w+)", line)[1] for line in submitted]
    assert rules == [*["rule_solve_wildcards_rubber_lca_1"] * 2, "rule_decide"]
    first, second, _ = (int(re.search(r"--mem (\d+)", line)[1]) for line in submitted)
    assert second > first
    assert small_tree.states(april) == ["OUT_OF_MEMORY", "COMPLETED", "COMPLETED"]
    assert (april / "results/5_solve/rubber/lca/batch_1.jsonl").is_file()


def test_the_reports_page_is_the_laboratorys(april):
    page = (DOCS / "how-to/laboratory-page.md").read_text("utf-8")
    settings = re.search(r"^```yaml\n# config/mine.yaml\n(.*?)^```$", page, re.M | re.S)[1]
    (april / "config/mine.yaml").write_text(settings, encoding="utf-8")
    (april / "my_report").mkdir()
    (april / "my_report/logo.svg").write_text(LOGO, encoding="utf-8")
    shell(april, "nptcs run --configfile config/mine.yaml")
    report = (april / "results/report.html").read_text("utf-8")
    assert "Composite Tyre Laboratory" in report
    assert "CTL-2026-017" in report


def test_the_study_runs_by_each_of_its_commands(april):
    """The first one writes the report again, without the laboratory's page."""
    assert "report: results/report.html" in shell(april, "nptcs run")
    assert "Nothing to be done" in shell(april, "make run")
    assert "Nothing to be done" in shell(april, "snakemake -j8 --resources licence_tokens=16")


def test_a_deck_is_written_for_a_case_of_the_run(april):
    shell(
        april,
        "nptcs deck results/4_design/rubber.csv rubber_013 --solver abaqus --card "
        "results/material_card.json --ply cfrp --spacing 15 --thickness 1.8 --angle 45 -o tyre.inp",
    )
    assert "*HEADING" in (april / "tyre.inp").read_text("utf-8").upper()


def test_a_stand_in_for_abaqus_checks_that_deck(april):
    printed = shell(april, "abaqus job=tyre input=tyre.inp datacheck interactive")
    assert "Abaqus JOB tyre COMPLETED" in printed
    assert (april / "tyre.dat").read_text("utf-8") == ""


@pytest.mark.parametrize(
    ("line", "instead", "fault"),
    [
        ("*ELSET, ELSET=BANDFOOT", "*ELSET, ELSET=OTHER", "*SURFACE: no element set BANDFOOT"),
        ("*MATERIAL, NAME=CFRP", "*MATERIAL, NAME=GFRP", "*SHELL SECTION: no material CFRP"),
        ("*NSET, NSET=RIM-REF", "*NSET, NSET=RIM-REF\n999", "*NSET, RIM-REF: no member 999"),
        ("*STATIC", "*STATICS", "*STATICS is not a keyword"),
        ("*END ASSEMBLY", "** *END ASSEMBLY", "at level assembly"),
    ],
)
def test_a_deck_with_a_fault_does_not_pass(april, line, instead, fault):
    deck = (april / "tyre.inp").read_text("utf-8")
    assert deck.count(f"\n{line}\n") == 1
    (april / "broken.inp").write_text(deck.replace(f"\n{line}\n", f"\n{instead}\n"), "utf-8")
    shell(april, "abaqus job=broken input=broken.inp datacheck interactive", code=1)
    assert fault in (april / "broken.dat").read_text("utf-8")


def test_two_runs_are_compared(april):
    printed = shell(april, "nptcs compare ../march .", code=1)
    assert "rubber" in printed
    shutil.copy2(april / "study.zip", april / "march.zip")
    shell(april, "nptcs archive april.zip")
    shell(
        april,
        "nptcs compare march.zip april.zip --page changes.html --workbook changes.xlsx",
        code=1,
    )
    assert "march.zip" in (april / "changes.html").read_text("utf-8")
    assert (april / "changes.xlsx").is_file()


def test_a_design_is_found_and_confirmed(april):
    printed = shell(april, "nptcs design --target 'K=300±5@5000' --minimise plate_mass --confirm")
    assert "inside" in printed


def test_the_joint_study_runs_on_top(april):
    printed = shell(april, "nptcs run --cores 4 --configfile config/joint.yaml")
    assert "joint/ring 6/6" in printed
    assert "Nothing to be done" in shell(april, "make joint")
