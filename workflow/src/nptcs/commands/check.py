"""``nptcs check``: find faults of the configuration and the specimen sheet before a run."""

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
        "--cases",
        default="results/tables/cases.csv",
        help="cases of an earlier run, from whose wall times the time is estimated; default: "
        "%(default)s",
    )
    parser.set_defaults(run=run)


def run(arguments: argparse.Namespace) -> int:
    """Print what is planned, or every fault; exit code 1 if there is one."""
    import yaml

    from nptcs.campaign.times import seconds_per_case, time_in_words
    from nptcs.config.root import read_config
    from nptcs.errors import InputError
    from nptcs.solvers.registry import check_study
    from nptcs.tables.specimens import read_sheet

    path = Path(arguments.config)
    if not path.is_file():
        raise InputError("this file does not exist", file=path, remedy="name a configuration file")
    try:
        values = yaml.safe_load(path.read_text(encoding="utf-8")) or {}
    except yaml.YAMLError as error:
        raise InputError(f"not YAML: {error}", file=path, remedy="correct the syntax") from None
    config = read_config(values, str(path))
    seconds = seconds_per_case(Path(arguments.cases))
    for study in config.studies:
        check_study(study, config.solver_options(study))
        cases = study.number_of_cases()
        print(f"study {study.name}: {cases} cases ({study.design.kind}) by each of its solvers")
        for solver in study.solvers:
            print(f"  {solver}: {time_in_words(cases, seconds.get(solver))}")
    specimens, errors = read_sheet(config.lab_data.specimen_sheet)
    folder = Path(config.lab_data.specimen_sheet).parent
    missing = [
        InputError(
            "this raw file does not exist",
            file=folder / name,
            specimen=specimen.specimen,
            remedy="correct the file name in the specimen sheet, or put the file there",
        )
        for specimen in specimens
        for name in specimen.files
        if not (folder / name).is_file()
    ]
    print(f"{config.lab_data.specimen_sheet}: {len(specimens)} specimens")
    for fault in [*errors, *missing]:
        print(f"nptcs: {fault}", file=sys.stderr)
    return 1 if errors or missing else 0
