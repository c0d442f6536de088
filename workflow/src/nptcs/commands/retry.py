"""``nptcs retry``: let the next run solve failed cases again, whatever made them fail."""

from __future__ import annotations

import argparse
from pathlib import Path

from nptcs.arguments import add_command, existing_folder


def register(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Declare the command."""
    parser = add_command(
        subparsers,
        "retry",
        "let the next run solve failed cases again",
        "Cases that were killed, ran out of memory or time, or did not get a licence "
        "are tried again by every run. This command adds those on which a solver gave up.",
        "nptcs retry plate rubber",
    )
    parser.add_argument("studies", nargs="*", metavar="STUDY", help="default: all studies")
    parser.add_argument(
        "--results",
        type=existing_folder,
        default="results",
        help="folder of the results; default: %(default)s",
    )
    parser.set_defaults(run=run)


def run(arguments: argparse.Namespace) -> int:
    """Mark the batches with failed cases, and print how many such cases there are."""
    from nptcs.campaign.cases import read_cases
    from nptcs.campaign.tries import try_again
    from nptcs.errors import InputError
    from nptcs.tables.status import has_result

    solved = Path(arguments.results) / "5_solve"
    batches = sorted([*solved.glob("*/*/batch_*.jsonl"), *solved.glob("*/*/bulk_*.npz")])
    present = {batch.parts[-3] for batch in batches}
    if unknown := sorted(set(arguments.studies) - present):
        raise InputError(
            "no cases of this study have been solved",
            f"name one of {', '.join(sorted(present)) or 'none'}",
            file=solved,
            value=", ".join(unknown),
        )
    failed = 0
    for batch in batches:
        if arguments.studies and batch.parts[-3] not in arguments.studies:
            continue
        bad = int((~has_result(read_cases([str(batch)])["status"])).sum())
        if bad:
            try_again(batch)
        failed += bad
    print(f"failed cases that the next run solves again: {failed}")
    return 0
