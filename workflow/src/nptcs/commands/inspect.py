"""``nptcs inspect``: show how a raw file is read."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any


def register(subparsers: Any) -> None:
    """Declare the arguments."""
    parser = subparsers.add_parser(
        "inspect", help="show encoding, columns and units of a raw file", description=__doc__
    )
    parser.add_argument("file", type=Path, help="raw file of a test machine or camera")
    parser.add_argument("--format", default="", help="name of a profile; default: detect")
    parser.add_argument(
        "--formats", type=Path, default=Path("config/formats"), help="folder of profiles"
    )
    parser.add_argument(
        "--write-profile", type=Path, metavar="YAML", help="write a profile to start from"
    )
    parser.add_argument(
        "--config",
        type=Path,
        default=Path("config/config.yaml"),
        help="configuration whose limits on the size of files count; default: %(default)s",
    )
    parser.set_defaults(run=run)


def run(arguments: argparse.Namespace) -> int:
    """Print the inspection; 0 if the file can be used."""
    from nptcs.config.ingest import limits_in
    from nptcs.errors import InputError
    from nptcs.files import write_text
    from nptcs.ingest.inspect import describe, draft_profile, inspect_file
    from nptcs.ingest.reading.profiles import choose, load_profiles

    profiles = load_profiles(arguments.formats)
    declared = choose(arguments.format, profiles, "") if arguments.format else None
    inspection = inspect_file(arguments.file, profiles, declared, limits_in(arguments.config))
    print(describe(inspection))
    if arguments.write_profile is not None:
        target = arguments.write_profile
        if target.exists():
            raise InputError("this file exists already", "choose another name", target)
        write_text(target, draft_profile(inspection, target.stem))
        print(f"\nprofile written to {target}: check every line of it")
    return 0 if inspection.usable else 1
