"""Arguments of commands, checked while they are read, so that nothing long starts with a wrong one.

Each function returns a type for `argparse`; a refusal names the argument, the value and what is
allowed.
"""

from __future__ import annotations

import argparse
import os
from collections.abc import Callable, Sequence
from math import isfinite
from pathlib import Path
from typing import NoReturn

from nptcs.errors import InputError
from nptcs.ranges import RANGES, Range

FIGURES = (".png", ".svg", ".pdf")
"""Endings of figures that matplotlib writes without another program."""


class HelpFormatter(argparse.HelpFormatter):
    """Wraps descriptions, and leaves examples as they are written."""

    def _fill_text(self, text: str, width: int, indent: str) -> str:
        if text.startswith("example"):
            return "".join(indent + line for line in text.splitlines(keepends=True))
        return super()._fill_text(text, width, indent)


class Parser(argparse.ArgumentParser):
    """A parser whose errors are `InputError`, as those of any other input."""

    def error(self, message: str) -> NoReturn:
        """Refuse the arguments.

        Raises
        ------
        InputError
        """
        raise InputError(message, f"'{self.prog} --help' describes them")


def add_command(
    subparsers: argparse._SubParsersAction[argparse.ArgumentParser],
    name: str,
    summary: str,
    description: str,
    *examples: str,
) -> argparse.ArgumentParser:
    """Declare a command with its examples.

    Parameters
    ----------
    subparsers : argparse action
        Of the parser of ``nptcs``, or of a command that has actions.
    name, summary, description : str
        The command, a short summary of what it does, and the full description.
    *examples : str
        Command lines as they can be typed.
    """
    lines = "\n".join(f"  {example}" for example in examples)
    head = "example" if len(examples) == 1 else "examples"
    return subparsers.add_parser(
        name,
        help=summary,
        description=description,
        epilog=f"{head}:\n{lines}",
        formatter_class=HelpFormatter,
    )


def add_card(parser: argparse.ArgumentParser) -> None:
    """Declare from which card the materials are taken."""
    parser.add_argument(
        "--card",
        type=_card,
        metavar="CARD.json",
        help="material card, or 'published' for table 2 of the paper; default: "
        "results/material_card.json if a run has written it here, otherwise the paper's",
    )
    parser.add_argument("--ply", help="name of a ply of the card, if it has several")


def add_project(parser: argparse.ArgumentParser) -> None:
    """Declare in which project folder the command works."""
    parser.add_argument(
        "--project",
        type=existing_folder,
        default=".",
        help="the project folder; default: the current one",
    )


def add_reading(parser: argparse.ArgumentParser) -> None:
    """Declare by which profiles and limits raw files are read."""
    parser.add_argument(
        "--formats",
        type=existing_folder,
        default="config/formats",
        help="folder of profiles; default: %(default)s",
    )
    parser.add_argument(
        "--config",
        type=Path,
        default=Path("config/config.yaml"),
        help="configuration with the limits on file sizes; default: %(default)s",
    )


def _card(text: str) -> str:
    return text if text == "published" else existing_file(text)


def number_type(allowed: Range) -> Callable[[str], float]:
    """Return the type of a number in a range."""

    def read(text: str) -> float:
        try:
            value = float(text)
        except ValueError:
            value = float("nan")
        if not isfinite(value):
            raise argparse.ArgumentTypeError(f"must be a number {allowed}, got {text!r}")
        if fault := allowed.fault(value):
            raise argparse.ArgumentTypeError(fault)
        return value

    return read


def factor_type(name: str) -> Callable[[str], float]:
    """Return the type of a factor of a design, or of the load, by its column name."""
    return number_type(RANGES[name])


def whole_number_type(least: int, most: int | None = None) -> Callable[[str], int]:
    """Return the type of a whole number of at least `least`, and at most `most`."""
    allowed = Range(least, float("inf") if most is None else most)

    def read(text: str) -> int:
        try:
            value = int(text)
        except ValueError:
            message = f"must be a whole number {allowed}, got {text!r}"
            raise argparse.ArgumentTypeError(message) from None
        if fault := allowed.fault(value):
            raise argparse.ArgumentTypeError(fault)
        return value

    return read


def existing_file(text: str) -> str:
    """Read the name of a file that must exist."""
    path = Path(text)
    if path.is_dir():
        raise argparse.ArgumentTypeError(f"{text} is a folder; name a file")
    if not path.is_file():
        raise argparse.ArgumentTypeError(f"the file {text} does not exist")
    return text


def existing_folder(text: str) -> Path:
    """Read the name of a folder that must exist."""
    path = Path(text)
    if path.is_file():
        raise argparse.ArgumentTypeError(f"{text} is a file; name a folder")
    if not path.is_dir():
        raise argparse.ArgumentTypeError(f"the folder {text} does not exist")
    return path


def output_file(*endings: str) -> Callable[[str], str]:
    """Return the type of a file that is to be written, with one of these endings if any is given.

    Its folder must exist and be writable.
    """

    def read(text: str) -> str:
        path = Path(text)
        if path.is_dir():
            raise argparse.ArgumentTypeError(f"{text} is a folder; name a file")
        if endings and path.suffix.lower() not in endings:
            raise argparse.ArgumentTypeError(
                f"the name must end in {_alternatives(endings)}, got {text!r}"
            )
        _check_writable(path.parent)
        return text

    return read


def output_folder(text: str) -> Path:
    """Read the name of a folder to write to; it is made if its parent exists."""
    path = Path(text)
    if path.exists() and not path.is_dir():
        raise argparse.ArgumentTypeError(f"{text} is a file; name a folder")
    _check_writable(path if path.is_dir() else path.parent)
    return path


def _check_writable(folder: Path) -> None:
    if not folder.is_dir():
        raise argparse.ArgumentTypeError(
            f"the folder {folder} does not exist; make it first: mkdir -p '{folder}'"
        )
    if not os.access(folder, os.W_OK):
        raise argparse.ArgumentTypeError(f"no permission to write to the folder {folder.resolve()}")


def _alternatives(words: Sequence[str]) -> str:
    return words[0] if len(words) == 1 else f"{', '.join(words[:-1])} or {words[-1]}"
