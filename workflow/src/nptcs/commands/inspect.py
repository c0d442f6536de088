"""``nptcs inspect``: show how a raw file is read."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any

from nptcs.arguments import add_command, add_reading, existing_file, output_file


def register(subparsers: Any) -> None:
    """Declare the arguments."""
    parser = add_command(
        subparsers,
        "inspect",
        "show encoding, columns and units of a raw file",
        "Shows how a raw file is read: its encoding, separators, columns, units and number of "
        "rows, the profile that fits, and whether everything that is needed was found.",
        "nptcs inspect raw_data/example/C0-1.TRA",
        "nptcs inspect mine.csv --write-profile config/formats/mine.yaml",
    )
    parser.add_argument("file", type=existing_file, help="raw file of a test machine or camera")
    parser.add_argument("--format", default="", help="name of a profile; default: detect")
    parser.add_argument(
        "--write-profile",
        type=output_file(".yaml", ".yml"),
        metavar="YAML",
        help="write a profile to start from",
    )
    add_reading(parser)
    parser.set_defaults(run=run)


def run(arguments: argparse.Namespace) -> int:
    """Print the inspection; 0 if the file can be used and no load or strain was left unread."""
    from nptcs.config.materials.ingest import limits_in
    from nptcs.errors import InputError
    from nptcs.files import write_text
    from nptcs.ingest.inspect import draft_profile, inspect_file, inspection_text
    from nptcs.ingest.reading.profiles import choose, load_profiles

    profiles = load_profiles(arguments.formats)
    declared = choose(arguments.format, profiles, "") if arguments.format else None
    inspection = inspect_file(Path(arguments.file), profiles, declared, limits_in(arguments.config))
    print(inspection_text(inspection))
    if arguments.write_profile is not None:
        target = Path(arguments.write_profile)
        if target.exists():
            raise InputError("this file exists already", "choose another name", target)
        write_text(target, draft_profile(inspection, target.stem))
        print(f"\nprofile written to {target}: check every line of it")
    return 0 if inspection.usable and not inspection.unread() else 1
