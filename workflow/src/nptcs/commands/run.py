"""``nptcs run``: run the study from raw files to the report, on Snakemake."""

from __future__ import annotations

import argparse
import os
import sys
from pathlib import Path

from nptcs.arguments import add_command, add_project, existing_file, whole_number_type

CONFIG = "config/config.yaml"
"""The configuration that the Snakefile itself names; further files override it."""


def register(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Declare the command."""
    parser = add_command(
        subparsers,
        "run",
        "run the study: from raw files to report and workbook",
        "Runs what is missing or out of date, and nothing else; after any stop the same command "
        "continues. It is 'snakemake -jN' with the settings of this project: whatever Snakemake "
        "can do, 'snakemake' in this folder does too. The plan is printed first, then one line "
        "that shows how far the run has got, each failure, and where report and workbook are.",
        "nptcs run",
        "nptcs run --cores 4 --configfile config/joint.yaml",
        "nptcs run --dry-run",
        "nptcs run results/material_card.json",
    )
    parser.add_argument(
        "targets",
        nargs="*",
        metavar="TARGET",
        help="a rule or a file of results; default: everything. What follows -- is passed to "
        "Snakemake unchanged",
    )
    parser.add_argument(
        "-j",
        "--cores",
        type=whole_number_type(1),
        default=usable_cores(),
        metavar="N",
        help="cores to use; default: all of this machine",
    )
    parser.add_argument(
        "--configfile",
        nargs="+",
        default=[],
        metavar="FILE",
        help=f"configuration files on top of {CONFIG}; later files override earlier ones",
    )
    parser.add_argument(
        "-y",
        "--yes",
        action="store_true",
        help="solve studies of any size; without it, a study with more cases than "
        "campaign.most_cases is refused",
    )
    parser.add_argument(
        "-n", "--dry-run", action="store_true", help="list what would be run, and run nothing"
    )
    add_project(parser)
    parser.set_defaults(run=run)


def usable_cores() -> int:
    """Return the number of cores that this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def run(arguments: argparse.Namespace) -> int:
    """Become Snakemake, which then gets all signals itself."""
    from nptcs.errors import InputError

    project: Path = arguments.project
    if not (project / "Snakefile").is_file():
        raise InputError(
            "there is no Snakefile in this folder",
            "go to the project folder, or name it with --project",
            project.resolve(),
        )
    os.chdir(project)
    command = snakemake_command(arguments)
    sys.stdout.flush()
    os.execve(command[0], command, environment())


def snakemake_command(arguments: argparse.Namespace) -> list[str]:
    """Return the command line of Snakemake, in the project folder.

    Raises
    ------
    InputError
        For a configuration file that does not exist, or with ``--yes`` for its faults.
    """
    from nptcs.errors import InputError

    for name in arguments.configfile:
        try:
            existing_file(name)
        except argparse.ArgumentTypeError as error:
            raise InputError(f"argument --configfile: {error}", "name YAML files") from None
    command = [sys.executable, "-m", "snakemake", *arguments.targets, f"-j{arguments.cores}"]
    if arguments.dry_run:
        command.append("--dry-run")
    if arguments.configfile:
        command += ["--configfile", *arguments.configfile]
    if arguments.yes and (most := _largest_study(arguments.configfile)) is not None:
        command += ["--config", f"campaign={{most_cases: {most}}}"]
    return command


def _largest_study(files: list[str]) -> int | None:
    """Return the number of cases of the largest study, if it is above ``campaign.most_cases``."""
    from nptcs.config.files import read_config_files

    config = read_config_files([CONFIG, *files])
    most = max(study.number_of_cases() for study in config.studies)
    return most if most > config.campaign.most_cases else None


def environment() -> dict[str, str]:
    """Return the environment of Snakemake: it and its jobs find this package."""
    import nptcs

    source = str(Path(nptcs.__file__).parents[1])
    path = os.pathsep.join(filter(None, [source, os.environ.get("PYTHONPATH", "")]))
    return {**os.environ, "PYTHONPATH": path}
