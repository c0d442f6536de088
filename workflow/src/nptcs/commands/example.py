"""``nptcs example``: write the synthetic example data for a seed."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any


def register(subparsers: Any) -> None:
    """Declare the arguments."""
    parser = subparsers.add_parser(
        "example", help="write the synthetic example data", description=__doc__
    )
    parser.add_argument("folder", type=Path, help="folder to write to")
    parser.add_argument("--seed", type=int, default=None, help="default: that of raw_data/example")
    parser.set_defaults(run=run)


def run(arguments: argparse.Namespace) -> int:
    """Write the files."""
    from nptcs.example.generate import SEED, generate

    seed = SEED if arguments.seed is None else arguments.seed
    generate(arguments.folder, seed)
    print(f"synthetic example data of seed {seed} written to {arguments.folder}")
    return 0
