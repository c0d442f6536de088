"""``nptcs check``: find faults in the configuration and the specimen sheet before a run."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from nptcs.arguments import add_command, existing_file


def register(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Declare the command."""
    parser = add_command(
        subparsers,
        "check",
        "find faults in configuration and specimen sheet, and print the plan of a run",
        "Reads configuration, specimen sheet and raw files, names every fault with its remedy, and "
        "prints how many cases each solver has to solve, how many are known, and about how long "
        "that takes. Nothing is run. Exit code 1: faults in the sheet; 2: faults in the studies.",
        "nptcs check config/config.yaml",
    )
    parser.add_argument(
        "config",
        nargs="?",
        type=existing_file,
        default="config/config.yaml",
        help="configuration file; default: %(default)s",
    )
    parser.add_argument(
        "--results",
        default="results",
        help="folder of earlier results, for known cases and times; default: %(default)s",
    )
    parser.set_defaults(run=run)


def run(arguments: argparse.Namespace) -> int:
    """Print what is planned, or every fault; exit code 2 for faults of studies, 1 for the sheet."""
    from nptcs.calibrate.plan import check_materials
    from nptcs.campaign.checks import name_faults, study_faults
    from nptcs.campaign.plan import plan_lines
    from nptcs.config.files import read_config_files
    from nptcs.ingest.check_files import check_files
    from nptcs.ingest.reading.profiles import load_profiles
    from nptcs.report.page_files import page_faults
    from nptcs.solvers.registry import needs_ply
    from nptcs.tables.laboratory.specimens import read_sheet

    config = read_config_files([arguments.config])
    faults = [*study_faults(config), *page_faults(config)]
    if not faults:
        print(*plan_lines(config, arguments.results), sep="\n")
    specimens, errors = read_sheet(config.lab_data.specimen_sheet)
    sheet = Path(config.lab_data.specimen_sheet)
    profiles = load_profiles(config.lab_data.formats)
    of_files, remarks = check_files(specimens, sheet, config.ingest, profiles)
    print(f"{config.lab_data.specimen_sheet}: {len(specimens)} specimens")
    studies = [(study, needs_ply(study, config.solver_options(study))) for study in config.studies]
    materials, notes = check_materials(studies, specimens, config.calibration)
    for note in [*notes, *remarks]:
        print(note)
    of_rows = [*errors, *of_files, *materials, *name_faults(specimens, config)]
    for fault in [*faults, *of_rows]:
        print(f"nptcs: {fault}", file=sys.stderr)
    return 2 if faults else 1 if of_rows else 0
