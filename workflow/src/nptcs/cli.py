"""The command line: ``nptcs COMMAND``; each command is a module of `nptcs.commands`."""

from __future__ import annotations

import argparse
import importlib
import pkgutil
import sys
from collections.abc import Sequence

from nptcs import __version__, commands
from nptcs.errors import InputError, explained
from nptcs.threads import one_thread_per_process


def main(arguments: Sequence[str] | None = None) -> int:
    """Run a command; bad input is one clear line and exit code 2."""
    one_thread_per_process()
    chosen = build_parser().parse_args(arguments)
    try:
        code: int = chosen.run(chosen)
    except InputError as error:
        print(f"nptcs: {error}", file=sys.stderr)
        return 2
    except OSError as error:
        known = explained(error)
        if known is None:
            raise
        print(f"nptcs: {known}", file=sys.stderr)
        return 2
    return code


def build_parser() -> argparse.ArgumentParser:
    """Collect the subcommands of all modules in `nptcs.commands`."""
    parser = argparse.ArgumentParser(
        prog="nptcs",
        description="Laboratory data and solvers for non-pneumatic tyres with composite spokes. "
        "The whole pipeline runs with: snakemake -j2",
    )
    parser.add_argument("--version", action="version", version=f"nptcs {__version__}")
    subparsers = parser.add_subparsers(required=True, metavar="COMMAND", title="commands")
    for module in sorted(pkgutil.iter_modules(commands.__path__), key=lambda found: found.name):
        importlib.import_module(f"nptcs.commands.{module.name}").register(subparsers)
    return parser


if __name__ == "__main__":
    sys.exit(main())
