"""Each command has a description and an example that it accepts."""

import argparse
import shlex
from pathlib import Path

import pytest

from nptcs.arguments import HelpFormatter
from nptcs.cli import build_parser, main

ROOT = Path(__file__).parents[3]
DOCUMENTS = (".csv", ".json", ".zip", ".TRA", ".yaml")


def commands(parser, name=""):
    """Yield each command with its parser, those with actions too."""
    for action in parser._actions:
        if isinstance(action, argparse._SubParsersAction):
            for word, sub in action.choices.items():
                yield f"{name} {word}".strip(), sub
                yield from commands(sub, f"{name} {word}".strip())


COMMANDS = dict(commands(build_parser()))


def examples(parser):
    """Return the command lines of a parser's examples."""
    head, *lines = parser.epilog.partition("\n\n")[0].splitlines()
    assert head in ("example:", "examples:")
    return [line.strip() for line in lines]


@pytest.mark.parametrize("name", COMMANDS)
def test_each_command_says_what_it_does_and_shows_an_example(name):
    parser = COMMANDS[name]
    assert len(parser.description.split()) > 8
    assert "``" not in parser.description
    assert examples(parser)


@pytest.mark.parametrize("name", COMMANDS)
def test_each_option_is_described(name):
    for action in COMMANDS[name]._actions:
        assert action.help or isinstance(action, argparse._SubParsersAction), action.dest


@pytest.mark.parametrize("name", COMMANDS)
def test_the_examples_are_accepted(name, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    for folder in (
        "config/formats",
        "raw_data/mine",
        "results/5_solve",
        "results/6_surface/models",
    ):
        Path(folder).mkdir(parents=True)
    for file in ("config/config.yaml", "config/joint.yaml"):
        Path(file).touch()
    for example in examples(COMMANDS[name]):
        program, *words = shlex.split(example)
        assert program == "nptcs"
        for before, word in zip(["", *words], words, strict=False):
            if word.endswith(DOCUMENTS) and before not in ("-o", "--write-profile"):
                Path(word).parent.mkdir(parents=True, exist_ok=True)
                Path(word).touch()
        build_parser().parse_args(words)


def test_no_command_shows_the_commands(capsys):
    assert main([]) == 2
    said = capsys.readouterr().err
    assert "COMMAND" in said
    assert "'nptcs --help'" in said


def test_a_misspelt_command_is_one_line(capsys):
    assert main(["chek"]) == 2
    assert "invalid choice: 'chek'" in capsys.readouterr().err


def test_examples_keep_their_lines_and_descriptions_are_wrapped():
    formatter = HelpFormatter("nptcs", width=40)
    assert formatter._fill_text("examples:\n  a\n  b", 40, "") == "examples:\n  a\n  b"
    assert formatter._fill_text("word " * 20, 40, "").count("\n") == 2
