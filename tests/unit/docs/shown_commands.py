"""The commands that the docs show: where they are, and whether the program accepts them.

A command is a line of a fenced ``sh`` block, or a code span in a sentence that begins with the name
of a program. Each program has a check that runs nothing: its own parser, the targets of the
Makefile, the files and options of a script.
"""

from __future__ import annotations

import argparse
import contextlib
import io
import re
import shlex
import tomllib
from pathlib import Path

ROOT = Path(__file__).parents[3]
SH_BLOCK = re.compile(
    r"^```(?:sh|bash|shell|console)\b *([^\n]*)\n(.*?)^```$", re.MULTILINE | re.DOTALL
)
ANY_BLOCK = re.compile(r"^```.*?^```$", re.MULTILINE | re.DOTALL)
SPAN = re.compile(r"`((?:nptcs|snakemake|make|python|pip) [^`]+)`")
EXAMPLE = re.compile(r"^ +(nptcs .*?)(?:  .*)?$", re.MULTILINE)
PLACEHOLDER = re.compile(r"…|\bCOMMAND\b|\.\.\.|-jN\b")


def in_blocks(text: str, only_run: bool = False) -> list[str]:
    """Return the commands of a page's shell blocks, with lines joined and without comments.

    With `only_run` only those of blocks without words after the language: on a page that is
    followed, such words say what a block needs that the page has not made.
    """
    blocks = [block for words, block in SH_BLOCK.findall(text) if not (only_run and words)]
    joined = "\n".join(blocks).replace("\\\n", " ")
    lines = [shlex.join(shlex.split(line, comments=True)) for line in joined.splitlines()]
    return [part.strip() for line in lines if line for part in line.split(" '&&' ")]


def in_sentences(text: str) -> list[str]:
    """Return the commands in code spans; a span with a placeholder for words shows no command."""
    spans = SPAN.findall(ANY_BLOCK.sub("", text).replace("\n", " "))
    return [" ".join(span.split()) for span in spans if not PLACEHOLDER.search(span)]


def fault(command: str) -> str | None:
    """Return why a program would not accept a command, or None."""
    program, *arguments = shlex.split(command)
    check = CHECKS.get(program)
    if check is None:
        return f"no check for {program!r}: add one to {Path(__file__).name}"
    return check(arguments)


def nptcs(arguments: list[str]) -> str | None:
    """Ask the parser of the command line, which does not look whether files exist."""
    from nptcs.errors import InputError

    try:
        return _refusal(_parser().parse_args, arguments)
    except InputError as error:
        return str(error)


def _parser() -> argparse.ArgumentParser:
    """Return the parser of the command line, made to accept the name of any file."""
    from nptcs.cli import build_parser

    parser = build_parser()
    waiting: list[argparse.ArgumentParser] = [parser]
    while waiting:
        for action in waiting.pop()._actions:
            if isinstance(action, argparse._SubParsersAction):
                waiting += action.choices.values()
            elif "nptcs.arguments" in getattr(action.type, "__module__", "") and re.match(
                r"existing_|output_|_card", action.type.__qualname__
            ):
                action.type = str
    return parser


def fault_of_name(command: str) -> str | None:
    """Like `fault` for what a sentence names: arguments may be missing, but none may be wrong."""
    why = fault(command)
    if why is None or not re.search(r"arguments are required|expected one argument", why):
        return why
    _, name, *arguments = shlex.split(command)
    (subparsers,) = _parser()._subparsers._group_actions
    options = subparsers.choices[name]._option_string_actions
    unknown = [word for word in arguments if word.startswith("-") and word not in options]
    return f"nptcs {name} has no option {unknown}" if unknown else None


def snakemake(arguments: list[str]) -> str | None:
    """Ask Snakemake's parser; a file that is named for the configuration must exist."""
    from snakemake.cli import get_argument_parser

    at = [i + 1 for i, word in enumerate(arguments) if word in ("--configfile", "--profile")]
    missing = [arguments[i] for i in at if not (ROOT / arguments[i]).exists()]
    if missing:
        return f"does not exist: {missing}"
    return _refusal(get_argument_parser().parse_args, arguments)


def make(arguments: list[str]) -> str | None:
    """Look for the targets in the Makefile."""
    targets = set(re.findall(r"^([\w-]+):", (ROOT / "Makefile").read_text("utf-8"), re.MULTILINE))
    unknown = [word for word in arguments if "=" not in word and word not in targets]
    return f"the Makefile has no target {unknown}" if unknown else None


def python(arguments: list[str]) -> str | None:
    """Look for the script, and in the script for each option."""
    if arguments[:1] == ["-m"]:
        known = {"pytest", "venv", "build", "nptcs.cli", "twine"}
        return None if arguments[1] in known else f"unknown module {arguments[1]}"
    script = ROOT / arguments[0]
    if not script.is_file():
        return f"{arguments[0]} does not exist"
    text = script.read_text("utf-8")
    unknown = [word for word in arguments[1:] if word.startswith("--") and f'"{word}"' not in text]
    return f"{arguments[0]} has no option {unknown}" if unknown else None


def pip(arguments: list[str]) -> str | None:
    """Look for the constraints and for the extras of this package."""
    project = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]
    extras = set(re.findall(r"\[([\w,]+)\]", " ".join(arguments)))
    unknown = {name for group in extras for name in group.split(",")} - set(
        project["optional-dependencies"]
    )
    if arguments[:1] != ["install"] or unknown:
        return f"not an installation, or extras that do not exist: {unknown}"
    files = [arguments[i + 1] for i, word in enumerate(arguments) if word == "-c"]
    return next((f"{name} does not exist" for name in files if not (ROOT / name).is_file()), None)


def tool(arguments: list[str]) -> str | None:
    """Accept any command of the shell, or of a program that is not ours."""
    return None


CHECKS = {
    "nptcs": nptcs,
    "snakemake": snakemake,
    "make": make,
    "python": python,
    "pip": pip,
    **dict.fromkeys((".", "cat", "cp", "mkdir", "abaqus", "pre-commit"), tool),
}


def _refusal(parse, arguments: list[str]) -> str | None:
    """Return what a parser prints when it refuses the arguments."""
    printed = io.StringIO()
    with contextlib.redirect_stderr(printed), contextlib.redirect_stdout(printed):
        try:
            parse(arguments)
        except SystemExit as end:
            return printed.getvalue() if end.code else None
    return None
