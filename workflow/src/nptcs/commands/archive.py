"""``nptcs archive``: pack a finished study, with everything needed to run it again."""

from __future__ import annotations

import argparse
import os
import re
import subprocess
import sys
from pathlib import Path

from nptcs.arguments import add_command, add_project, output_file


def register(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Declare the command."""
    parser = add_command(
        subparsers,
        "archive",
        "pack a finished study into one file that can be checked and run again",
        "Packs inputs, configuration, tables, card, report, code and a description of "
        "the environment as an RO-Crate (a zip file) with a checksum for each file. 'nptcs "
        "verify' checks it.",
        "nptcs archive study.zip",
    )
    parser.add_argument(
        "archive",
        nargs="?",
        type=output_file(".zip"),
        default="study.zip",
        help="file to write; default: %(default)s",
    )
    add_project(parser)
    parser.set_defaults(run=run)


def run(arguments: argparse.Namespace) -> int:
    """Write the archive, and print its checksum."""
    from nptcs.archive.contents import contents_of
    from nptcs.archive.crate import write_crate
    from nptcs.config.root import read_config
    from nptcs.errors import InputError
    from nptcs.files import read_model, sha256_of_file
    from nptcs.runs.identity import RunIdentity
    from nptcs.yaml_files import read_yaml

    root, target = Path(arguments.project), Path(arguments.archive)
    made_with = root / "results" / "configuration.yaml"
    if not made_with.is_file():
        raise InputError(
            "there are no results to archive", "run snakemake to completion first", made_with
        )
    values = read_yaml(made_with)
    config = read_config(values if isinstance(values, dict) else {}, str(made_with))
    refuse_unfinished(root)
    count = write_crate(target, contents_of(root, config), config, commit_of(root))
    print(f"{target}: {count} files, {target.stat().st_size / 1e6:.1f} MB")
    print(f"SHA-256 {sha256_of_file(target)}")
    print(f"run {read_model(root / 'results' / 'identity.json', RunIdentity).identity}")
    return 0


def refuse_unfinished(root: Path) -> None:
    """Ask Snakemake what a run would do now, and refuse if it is more than the verdict.

    Raises
    ------
    InputError
        If results are missing, or older than inputs, configuration or code.
    """
    import nptcs
    from nptcs.errors import InputError

    source = str(Path(nptcs.__file__).parents[1])
    path = os.pathsep.join(filter(None, [source, os.environ.get("PYTHONPATH", "")]))
    command = [sys.executable, "-m", "snakemake", "-n", "--nolock"]
    done = subprocess.run(
        [*command, "--configfile", "results/configuration.yaml"],
        cwd=root,
        env={**os.environ, "PYTHONPATH": path},
        capture_output=True,
        text=True,
        check=False,
    )
    said = done.stdout + done.stderr
    if done.returncode:
        raise InputError(f"Snakemake cannot read this project: {said.strip()[-500:]}", file=root)
    pending = set(re.findall(r"^(?:local)?rule (\w+):$", said, re.MULTILINE)) - {"all", "verdict"}
    if pending:
        raise InputError(
            "the results are not those of the current inputs, configuration and code",
            "run snakemake to completion, then archive",
            root / "results",
            value=f"rules still to run: {', '.join(sorted(pending))}",
        )


def commit_of(root: Path) -> str:
    """Name the commit of a project folder, and whether it was changed since."""
    try:
        found = subprocess.run(
            ["git", "-C", str(root), "describe", "--always", "--dirty", "--abbrev=40"],
            capture_output=True,
            text=True,
            check=False,
        )
    except FileNotFoundError:
        return "not known: git is not installed"
    return found.stdout.strip() or "not known: the project is not a git repository"
