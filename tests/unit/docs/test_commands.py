"""Every command that the docs show is run by a test, or accepted by its program's parser.

`test_how_to.py` follows the tutorial and the how-to pages and so runs what they show. A command of
any other page, or of a page that is not followed, must be among these or listed in `NOT_RUN` with
the reason. Each command, run or not, must be one that its program takes.
"""

import importlib.util
import re
from pathlib import Path

import pytest

from nptcs.cli import build_parser

ROOT = Path(__file__).parents[3]
PAGES = [
    ROOT / "README.md",
    ROOT / "CONTRIBUTING.md",
    *sorted((ROOT / "docs").rglob("*.md")),
    *sorted((ROOT / "paper").glob("*.md")),
]


def load(name):
    spec = importlib.util.spec_from_file_location(name, Path(__file__).with_name(f"{name}.py"))
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


shown = load("shown_commands")
FOLLOWED = load("test_how_to").PAGES

DEFAULT_STUDY = "needs the finished default study, ten minutes of finite elements"
NOT_RUN = {
    "make run": "the run itself: .ci/run does it with the small study",
    "make test": "this test suite",
    "make setup": "the environment of whoever reads",
    ". .venv/bin/activate": "the environment of whoever reads",
    "nptcs inspect raw_data/my_lab/T0-1_wdw.txt --write-profile "
    "config/formats/my-machine.yaml": "add-a-vendor-format.md runs it on a file that needs one",
    "nptcs new-sheet raw_data/my_lab --fill 'T90: test=tension material=cfrp' --fill "
    "'S45: test=shear material=cfrp orientation_deg=45'": "the tutorial runs it with all series",
    "pip install snakemake-executor-plugin-cluster-generic": "changes the environment of the tests",
    "nptcs run": DEFAULT_STUDY,
    "nptcs run --cores 4 --configfile config/joint.yaml": DEFAULT_STUDY,
    "nptcs run --dry-run": "tests/unit/commands/test_run_command.py tests it",
    "nptcs run --configfile config/mine.yaml": "needs the laboratory's own files",
    "pip install pre-commit": "changes the environment that runs the tests",
    "pre-commit install": "writes into the repository",
    "nptcs deck results/4_design/rubber.csv rubber_013 --solver abaqus --card "
    "results/material_card.json --ply cfrp --spacing 15 --thickness 1.8 --angle 45 -o "
    "tyre.inp": DEFAULT_STUDY,
    "abaqus job=tyre input=tyre.inp datacheck interactive": "Abaqus needs a licence",
    "snakemake -j8 --resources licence_tokens=16": "Abaqus needs a licence",
    "nptcs fe-calibrate raw_data/published/table10_spoke_stiffness.csv "
    "raw_data/published/table5_plate_doe.csv --ring paper_mesh": "an hour of finite elements",
    "nptcs design --target 'K=300±5@5000' --minimise plate_mass --confirm": DEFAULT_STUDY,
    "nptcs compare ../march .": "tests/unit/runs/test_compare_runs.py runs it",
    "nptcs compare march.zip april.zip --page changes.html --workbook changes.xlsx": "the same",
    "nptcs verify study.zip --rerun again": "tests/workflow/test_elsewhere.py runs it",
    "pip install -c constraints.txt 'nptcs[slurm]'": "changes the environment that runs the tests",
    "snakemake --workflow-profile profiles/slurm": "needs Slurm: tests/slurm/cluster.py runs it",
}
OTHERS_PROGRAMS = {
    "snakemake --executor cluster-generic": "needs a plug-in and a queue that CI does not have",
}


def name(page):
    return str(page.relative_to(ROOT))


def not_ours(command):
    return any(command.startswith(start) for start in OTHERS_PROGRAMS)


@pytest.fixture(scope="module")
def blocks():
    return {name(page): shown.in_blocks(page.read_text("utf-8")) for page in PAGES}


def run_by_following():
    return {
        command
        for page in FOLLOWED
        for command in shown.in_blocks(page.read_text("utf-8"), only_run=True)
    }


def test_every_command_of_a_block_is_run_or_says_why_not(blocks):
    run = run_by_following()
    others = {
        command: page
        for page, commands in blocks.items()
        for command in commands
        if command not in run and not not_ours(command)
    }
    assert {c: page for c, page in others.items() if c not in NOT_RUN} == {}
    assert set(NOT_RUN) - set(others) == set(), "no page shows these any longer"


@pytest.mark.parametrize("page", PAGES, ids=name)
def test_each_command_is_one_that_its_program_takes(page):
    text = page.read_text("utf-8")
    # the blocks of a page that is followed are run, in a tree with its files
    commands = [] if page in FOLLOWED else shown.in_blocks(text)
    found = {command: shown.fault(command) for command in commands if not not_ours(command)}
    found |= {name: shown.fault_of_name(name) for name in shown.in_sentences(text)}
    assert {command: why for command, why in found.items() if why} == {}


def test_the_examples_of_the_command_line_are_commands():
    text = (ROOT / "docs" / "commands.md").read_text("utf-8")
    found = {command: shown.fault(command) for command in shown.EXAMPLE.findall(text)}
    assert found
    assert {command: why for command, why in found.items() if why} == {}


def test_each_test_that_runs_a_command_instead_exists():
    named = re.findall(r"tests/[\w/]+\.py", " ".join(NOT_RUN.values()))
    assert named
    assert [test for test in named if not (ROOT / test).is_file()] == []


def test_no_command_is_shown_in_a_block_without_a_language():
    programs = tuple(f"    {program} " for program in ("nptcs", "snakemake", "make", "python"))
    indented = {
        name(page): [
            line for line in page.read_text("utf-8").splitlines() if line.startswith(programs)
        ]
        for page in PAGES
        if page.name != "commands.md"
    }
    assert {page: lines for page, lines in indented.items() if lines} == {}


@pytest.mark.parametrize(
    ("command", "why"),
    [
        ("nptcs inspcet FILE", "invalid choice"),
        ("nptcs check --reslts results", "unrecognized arguments"),
        ("snakemake --no-such-option", "unrecognized arguments"),
        ("snakemake -j2 --configfile config/gone.yaml", "does not exist"),
        ("make runn", "no target"),
        ("python benchmarks/gone.py", "does not exist"),
        ("python benchmarks/abaqus_spoke.py --angels", "no option"),
        ("pip install 'nptcs[fats]'", "extras"),
        ("frobnicate", "no check"),
    ],
)
def test_a_wrong_command_is_noticed(command, why):
    assert why in shown.fault(command)


def test_a_wrong_option_in_a_sentence_is_noticed():
    assert shown.fault_of_name("nptcs deck --card") is None
    assert "no option" in shown.fault_of_name("nptcs deck --crad")


def test_the_reference_names_every_command():
    (subparsers,) = build_parser()._subparsers._group_actions
    page = (ROOT / "docs" / "commands.md").read_text("utf-8")
    assert [c for c in subparsers.choices if f"## `nptcs {c}`" not in page] == []
