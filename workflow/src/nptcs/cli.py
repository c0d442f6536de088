"""The command line: ``nptcs COMMAND``; each command is a module of `nptcs.commands`."""

from __future__ import annotations

import argparse
import importlib
import pkgutil
import sys
from collections.abc import Sequence

from nptcs import __version__, commands
from nptcs.arguments import HelpFormatter, Parser
from nptcs.errors import InputError, explained
from nptcs.threads import one_thread_per_process

EPILOG = """examples, in the order of a study:
  nptcs new-sheet raw_data/mine    propose a specimen sheet for a folder of exports
  nptcs check                      find faults and print the plan, without running anything
  nptcs run                        run the study and write results/report.html
  nptcs design --target K=300±5@5000 --minimise plate_mass
  nptcs COMMAND --help             describes a command, with an example"""


def main(arguments: Sequence[str] | None = None) -> int:
    """Run a command; bad input is one clear line and exit code 2."""
    one_thread_per_process()
    try:
        chosen = build_parser().parse_args(arguments)
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
    parser = Parser(
        prog="nptcs",
        description="From raw test files to response surfaces and designs of non-pneumatic tyres "
        "with composite spokes.",
        epilog=EPILOG,
        formatter_class=HelpFormatter,
    )
    parser.add_argument("--version", action="version", version=f"nptcs {__version__}")
    subparsers = parser.add_subparsers(required=True, metavar="COMMAND", title="commands")
    for module in sorted(pkgutil.iter_modules(commands.__path__), key=lambda found: found.name):
        importlib.import_module(f"nptcs.commands.{module.name}").register(subparsers)
    return parser


if __name__ == "__main__":
    sys.exit(main())
