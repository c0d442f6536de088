"""``nptcs example``: write the synthetic example data for a seed."""

from __future__ import annotations

import argparse
from typing import Any

from nptcs.arguments import add_command, output_folder, whole_number_type


def register(subparsers: Any) -> None:
    """Declare the arguments."""
    parser = add_command(
        subparsers,
        "example",
        "write the synthetic example data",
        "Writes raw files, a specimen sheet and a README of synthetic tests, the same for the same "
        "seed. Files in the folder with these names are replaced.",
        "nptcs example my_example --seed 7",
    )
    parser.add_argument("folder", type=output_folder, help="folder to write to")
    parser.add_argument(
        "--seed", type=whole_number_type(0), default=None, help="default: that of raw_data/example"
    )
    parser.set_defaults(run=run)


def run(arguments: argparse.Namespace) -> int:
    """Write the files."""
    from nptcs.example.generate import SEED, generate

    seed = SEED if arguments.seed is None else arguments.seed
    generate(arguments.folder, seed)
    print(f"synthetic example data of seed {seed} written to {arguments.folder}")
    return 0
