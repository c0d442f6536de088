"""``nptcs check``: find faults in the configuration and the specimen sheet before a run."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path


def register(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Declare the command."""
    parser = subparsers.add_parser(
        "check", help="check a configuration and its specimen sheet without running anything"
    )
    parser.add_argument(
        "config", nargs="?", default="config/config.yaml", help="default: %(default)s"
    )
    parser.add_argument(
        "--results",
        default="results",
        help="folder of earlier results, for known cases and times; default: %(default)s",
    )
    parser.set_defaults(run=run)


def run(arguments: argparse.Namespace) -> int:
    """Print what is planned, or every fault; exit code 2 for the studies, 1 for the sheet."""
    import yaml

    from nptcs.campaign.checks import name_faults, study_faults
    from nptcs.campaign.plan import plan_lines
    from nptcs.config.root import read_config
    from nptcs.errors import InputError
    from nptcs.tables.specimens import read_sheet

    path = Path(arguments.config)
    if not path.is_file():
        raise InputError(
            "this file does not exist", file=path, remedy="give the name of a configuration file"
        )
    try:
        values = yaml.safe_load(path.read_text(encoding="utf-8")) or {}
    except yaml.YAMLError as error:
        raise InputError(f"is not YAML: {error}", file=path, remedy="correct the syntax") from None
    config = read_config(values, str(path))
    faults = study_faults(config)
    if not faults:
        print(*plan_lines(config, arguments.results), sep="\n")
    specimens, errors = read_sheet(config.lab_data.specimen_sheet)
    folder = Path(config.lab_data.specimen_sheet).parent
    missing = [
        InputError(
            "this raw file does not exist",
            file=folder / name,
            specimen=specimen.specimen,
            remedy="correct the file name in the specimen sheet, or copy the file into its folder",
        )
        for specimen in specimens
        for name in specimen.files
        if not (folder / name).is_file()
    ]
    print(f"{config.lab_data.specimen_sheet}: {len(specimens)} specimens")
    of_rows = [*errors, *missing, *name_faults(specimens, config)]
    for fault in [*faults, *of_rows]:
        print(f"nptcs: {fault}", file=sys.stderr)
    return 2 if faults else 1 if of_rows else 0
