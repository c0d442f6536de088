"""``nptcs new-sheet``: propose a specimen sheet for a folder of raw files."""

from __future__ import annotations

import argparse
from collections.abc import Iterable
from typing import Any

from nptcs.arguments import add_command, add_reading, existing_folder


def register(subparsers: Any) -> None:
    """Declare the arguments."""
    parser = add_command(
        subparsers,
        "new-sheet",
        "propose a specimen sheet for a folder of exports",
        "Writes specimens.csv into a folder of raw files, one row per specimen, with what can be "
        "read from file names and headers; prints which cells are left to fill in. --fill fills "
        "the cells of a whole series at once.",
        "nptcs new-sheet raw_data/mine",
        "nptcs new-sheet raw_data/mine --fill 'C0: width_mm=15 thickness_mm=1.8'",
    )
    parser.add_argument("folder", type=existing_folder, help="folder with the raw files")
    add_reading(parser)
    parser.add_argument(
        "--fill",
        action="append",
        default=[],
        metavar="'SERIES: COLUMN=VALUE …'",
        help="fill all cells of a series that are empty or only proposed from words in file names; "
        "also in a sheet that exists already",
    )
    parser.set_defaults(run=run)


def run(arguments: argparse.Namespace) -> int:
    """Write ``specimens.csv`` into the folder, or fill in the one that it has."""
    from nptcs.config.materials.ingest import limits_in
    from nptcs.errors import InputError
    from nptcs.files import write_text
    from nptcs.ingest.fill_sheet import fill_rows, fill_text, kept_cells, parse_fill, read_rows
    from nptcs.ingest.new_sheet import propose_sheet
    from nptcs.ingest.reading.profiles import load_profiles

    folder = arguments.folder
    sheet, fills = folder / "specimens.csv", [parse_fill(text) for text in arguments.fill]
    if sheet.exists() and fills:
        text = sheet.read_text(encoding="utf-8")
        write_text(sheet, fill_text(text, fills))
        print(f"{sheet}: filled in; look at it, then: nptcs check")
        _say(kept_cells(read_rows(text)[2], fills))
        return 0
    if sheet.exists():
        raise InputError("this sheet exists already", "move or rename it first", sheet)
    limits = limits_in(arguments.config)
    proposal = propose_sheet(folder, load_profiles(arguments.formats), limits)
    kept = kept_cells(proposal.rows, fills)
    proposal.rows = fill_rows(proposal.rows, fills)
    write_text(sheet, proposal.text())
    print(f"{sheet}: {len(proposal.rows)} specimens proposed")
    for name, (count, wanted) in proposal.open_series().items():
        print(f"  series {name}, {count} rows: {_to_do(wanted)}")
    _say(f"not in the sheet: {name}: {reason}" for name, reason in proposal.left.items())
    _say(kept)
    return 0


def _say(lines: Iterable[str]) -> None:
    for line in lines:
        print(f"  {line}")


def _to_do(columns: list[str]) -> str:
    return f"fill in {', '.join(columns)}" if columns else "nothing left to fill in; check it"
