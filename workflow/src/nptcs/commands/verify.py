"""``nptcs verify``: check the archive of a study, and run it again on request."""

from __future__ import annotations

import argparse
import os
import subprocess
import sys
import tempfile
from pathlib import Path

from nptcs.arguments import add_command, number_type, whole_number_type
from nptcs.ranges import Range


def register(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Declare the command."""
    parser = add_command(
        subparsers,
        "verify",
        "check an archive made by 'nptcs archive', and run it again on request",
        "Every file must be as it was packed, none missing and none added; the "
        "configuration, the card and all tables must be valid. The checksums find damage and "
        "careless edits; against forgery compare the SHA-256 that 'nptcs archive' printed.",
        "nptcs verify study.zip",
        "nptcs verify study.zip --rerun study_again",
    )
    parser.add_argument("archive", help="the zip file, or the folder that it was unpacked to")
    parser.add_argument(
        "--rerun",
        metavar="FOLDER",
        help="unpack to this new folder, run the study there with the archived code, and compare "
        "its tables with the archived ones",
    )
    parser.add_argument(
        "--jobs", type=whole_number_type(1), default=2, help="cores of the run; default: 2"
    )
    parser.add_argument(
        "--within",
        type=number_type(Range(0, 1)),
        default=1e-6,
        help="relative difference up to which numbers of the new run count as the same: another "
        "processor rounds differently; default: %(default)s",
    )
    parser.set_defaults(run=run)


def run(arguments: argparse.Namespace) -> int:
    """Print what was checked; 1 for any fault or difference."""
    from nptcs.archive.verify import count_files, faults_of, run_identity, unpack
    from nptcs.errors import InputError
    from nptcs.files import sha256_of_file

    given = Path(arguments.archive)
    if not given.exists():
        remedy = "name a file made by 'nptcs archive'"
        raise InputError("this archive does not exist", remedy, given)
    if arguments.rerun and (given.is_dir() or Path(arguments.rerun).exists()):
        remedy = "give the zip file, and a folder that does not exist yet"
        raise InputError("a second run needs a new folder", remedy, arguments.rerun)
    with tempfile.TemporaryDirectory(prefix="nptcs-verify-") as temporary:
        folder = given
        if not given.is_dir():
            folder = Path(temporary)
            unpack(given, folder)
            print(f"SHA-256 {sha256_of_file(given)}")
        faults = faults_of(folder)
        for fault in faults:
            print(f"nptcs: {fault}", file=sys.stderr)
        if faults:
            return 1
        print(f"{given}: {count_files(folder)} files, all as packed; tables and card are valid")
        if (identity := run_identity(folder)) is not None:
            print(f"run {identity.identity}, {identity.made_text}")
    if arguments.rerun:
        return rerun(given, Path(arguments.rerun), arguments.jobs, arguments.within)
    return 0


def rerun(archive: Path, folder: Path, jobs: int, within: float) -> int:
    """Run an archived study in a new folder and compare its tables; 1 if any differs."""
    from nptcs.archive.same_tables import compare_folders
    from nptcs.archive.verify import unpack

    unpack(archive, folder)
    results, archived = folder / "results", folder / "archived_results"
    results.rename(archived)
    environment = {**os.environ, "PYTHONPATH": str(folder.absolute() / "workflow" / "src")}
    command = [sys.executable, "-m", "snakemake", f"-j{jobs}"]
    code = subprocess.run(command, cwd=folder, env=environment, check=False).returncode
    sound = (archived / "verdict.txt").is_file()
    if code and sound:
        print(f"nptcs: the run in {folder} ended with exit code {code}", file=sys.stderr)
        return 1
    found = compare_folders(archived / "tables", results / "tables")
    print(*found, sep="\n")
    return 0 if all(table.same(within) for table in found) else 1
