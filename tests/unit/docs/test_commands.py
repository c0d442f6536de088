"""Every command that the docs show in a block is run by a test.

`test_how_to.py` follows the tutorial and the how-to pages and so runs what they show. A command of
any other page, or of a page that is not followed, must be a text that a test hands to its function
`shell`. Each command must be one that its program takes, also where a stand-in runs it.
"""

import ast
import importlib.util
import shlex
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


def name(page):
    return str(page.relative_to(ROOT))


@pytest.fixture(scope="module")
def blocks():
    return {name(page): shown.in_blocks(page.read_text("utf-8")) for page in PAGES}


def run_by_following():
    return {
        command
        for page in FOLLOWED
        for command in shown.in_blocks(page.read_text("utf-8"), only_run=True)
    }


def run_by_tests():
    """Commands that a test hands to its function `shell`, whole and as the docs show them."""
    return {
        shlex.join(shlex.split(text))
        for file in (ROOT / "tests").rglob("test_*.py")
        for text in texts_for_the_shell(ast.parse(file.read_text("utf-8")))
    }


def texts_for_the_shell(module):
    return [
        word.value
        for call in ast.walk(module)
        if isinstance(call, ast.Call) and getattr(call.func, "id", None) == "shell"
        for word in call.args
        if isinstance(word, ast.Constant)
    ]


def test_every_command_of_a_block_is_run(blocks):
    run = run_by_following() | run_by_tests()
    not_run = {
        command: page
        for page, commands in blocks.items()
        for command in commands
        if command not in run
    }
    assert not_run == {}


@pytest.mark.parametrize("page", PAGES, ids=name)
def test_each_command_is_one_that_its_program_takes(page):
    text = page.read_text("utf-8")
    # the blocks of a page that is followed are run, in a tree with its files
    commands = [] if page in FOLLOWED else shown.in_blocks(text)
    found = {command: shown.fault(command) for command in commands}
    found |= {name: shown.fault_of_name(name) for name in shown.in_sentences(text)}
    assert {command: why for command, why in found.items() if why} == {}


def test_the_examples_of_the_command_line_are_commands():
    text = (ROOT / "docs" / "commands.md").read_text("utf-8")
    found = {command: shown.fault(command) for command in shown.EXAMPLE.findall(text)}
    assert found
    assert {command: why for command, why in found.items() if why} == {}


def test_only_what_is_handed_to_the_shell_counts():
    module = ast.parse("said = 'make run'\nshell(tree, 'nptcs run', code=0)\nother('make setup')")
    assert texts_for_the_shell(module) == ["nptcs run"]


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
