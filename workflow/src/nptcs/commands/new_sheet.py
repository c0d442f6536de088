"""``nptcs new-sheet``: propose a specimen sheet for a folder of raw files."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any


def register(subparsers: Any) -> None:
    """Declare the arguments."""
    parser = subparsers.add_parser(
        "new-sheet", help="propose a specimen sheet for a folder of exports", description=__doc__
    )
    parser.add_argument("folder", type=Path, help="folder with the raw files")
    parser.add_argument(
        "--formats", type=Path, default=Path("config/formats"), help="folder of profiles"
    )
    parser.set_defaults(run=run)


def run(arguments: argparse.Namespace) -> int:
    """Write ``specimens.csv`` into the folder, unless it has one."""
    from nptcs.errors import InputError
    from nptcs.files import write_text
    from nptcs.ingest.new_sheet import propose_sheet
    from nptcs.ingest.reading.profiles import load_profiles

    folder = arguments.folder
    if not folder.is_dir():
        raise InputError("is not a folder", "give the folder with the raw files", folder)
    sheet = folder / "specimens.csv"
    if sheet.exists():
        raise InputError("this sheet exists already", "move or rename it first", sheet)
    proposal = propose_sheet(folder, load_profiles(arguments.formats))
    write_text(sheet, proposal.text())
    print(f"{sheet}: {len(proposal.rows)} specimens proposed")
    wanted = ", ".join(f"{name} ({rows} rows)" for name, rows in proposal.open_cells().items())
    print(f"  to be filled in: {wanted}" if wanted else "  nothing left to fill in; check the rest")
    for name, reason in proposal.left.items():
        print(f"  not in the sheet: {name}: {reason}")
    return 0
