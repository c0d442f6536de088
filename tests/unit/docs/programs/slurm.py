"""A stand-in for the commands of Slurm: ``slurm.py sbatch …``, ``slurm.py sacct …`` and so on.

It takes the options that the plug-ins of Snakemake give, and no others, and prints what they read.
A job is started at once as a process of this machine; job number `STAND_IN_OUT_OF_MEMORY` runs out
of memory. `JOBS` has a folder for each job, named by its number, with its name, script and state;
and `submitted.txt`, the words of each submission.
"""

from __future__ import annotations

import argparse
import os
import subprocess
import sys
from contextlib import suppress
from pathlib import Path

JOBS = Path(os.environ["STAND_IN_JOBS"])
PARTITION = "lab"
SETTINGS = "MinJobAge               = 300 sec\nMaxArraySize            = 1001"
IN_A_JOB = 'if sh "$0/script"; then echo COMPLETED > "$0/state"; else echo "$1" > "$0/state"; fi'


def sbatch(words: list[str]) -> None:
    """Start a job and print its number."""
    parser = argparse.ArgumentParser("sbatch", allow_abbrev=False)
    parser.add_argument("--parsable", action="store_true", required=True)
    parser.add_argument("--job-name", default="job")
    parser.add_argument("--output", required=True)
    parser.add_argument("--export", choices=["ALL"])
    parser.add_argument("--comment")
    parser.add_argument("-p", dest="partition", choices=[PARTITION])
    parser.add_argument("-t", "--time", type=int, required=True)
    parser.add_argument("--mem", type=int, required=True)
    parser.add_argument("--requeue", action="store_true")
    parser.add_argument("--ntasks", type=int)
    parser.add_argument("--cpus-per-task", type=int, required=True)
    parser.add_argument("-D", dest="folder", default=".")
    parser.add_argument("--wrap")
    parser.add_argument("script", nargs="?")
    given = parser.parse_args(words)
    if (given.wrap is None) == (given.script is None):
        parser.error("either --wrap or a script")
    number, job = new_job()
    with (JOBS / "submitted.txt").open("a", encoding="utf-8") as file:
        file.write(f"{' '.join(words)}\n")
    (job / "state").write_text("RUNNING", encoding="utf-8")
    killed = str(number) == os.environ.get("STAND_IN_OUT_OF_MEMORY")
    script = given.wrap or Path(given.script).read_text("utf-8")
    (job / "script").write_text("exit 137" if killed else script, encoding="utf-8")
    with Path(given.output.replace("%j", str(number))).open("wb") as log:
        subprocess.Popen(
            ["sh", "-c", IN_A_JOB, str(job), "OUT_OF_MEMORY" if killed else "FAILED"],
            cwd=given.folder,
            env={**os.environ, "SLURM_JOB_ID": str(number)},
            stdout=log,
            stderr=subprocess.STDOUT,
            start_new_session=True,
        )
    (job / "name").write_text(given.job_name, encoding="utf-8")
    print(number)


def new_job() -> tuple[int, Path]:
    """Return the next free number and its folder."""
    JOBS.mkdir(exist_ok=True)
    number = 1
    while True:
        with suppress(FileExistsError):
            folder = JOBS / str(number)
            folder.mkdir()
            return number, folder
        number += 1


def srun(words: list[str]) -> None:
    """Run a command as the step of a job."""
    parser = argparse.ArgumentParser("srun", allow_abbrev=False)
    parser.add_argument("-n", type=int, required=True)
    parser.add_argument("--cpu-bind", choices=["q"])
    parser.add_argument("--cpus-per-task", type=int)
    parser.add_argument("--nodes", type=int)
    parser.add_argument("command", nargs=argparse.REMAINDER)
    command = parser.parse_args(words).command
    if "SLURM_JOB_ID" not in os.environ:
        parser.error("not in a job")
    os.execvp(command[0], command)


def sacct(words: list[str]) -> None:
    """Print number and state of the jobs of a name; no user has an account."""
    parser = argparse.ArgumentParser("sacct", allow_abbrev=False)
    parser.add_argument("-X", action="store_true")
    parser.add_argument("--parsable2", action="store_true")
    parser.add_argument("--clusters", choices=["all"])
    parser.add_argument("--noheader", action="store_true")
    parser.add_argument("--format", choices=["JobIdRaw,State", "Reason"])
    parser.add_argument("--starttime")
    parser.add_argument("--endtime", choices=["now"])
    parser.add_argument("--name")
    parser.add_argument("-j", dest="job")
    parser.add_argument("-nu", dest="user")
    parser.add_argument("-o", dest="columns", choices=["Account%256"])
    given, _ = parser.parse_known_args(words)  # the plug-in also gives it "| tail -1"
    for name in JOBS.glob("*/name"):
        if name.read_text("utf-8") == given.name:
            print(f"{name.parent.name}|{(name.parent / 'state').read_text('utf-8').strip()}")


def sinfo(words: list[str]) -> None:
    """Print the only partition, which is the default one."""
    assert words == ["-o", "%P"], words
    print(f"PARTITION\n{PARTITION}*")


def scontrol(words: list[str]) -> None:
    """Print the settings that the plug-in reads."""
    assert words == ["show", "config"], words
    print(SETTINGS)


COMMANDS = {command.__name__: command for command in (sbatch, srun, sacct, sinfo, scontrol)}

if __name__ == "__main__":
    COMMANDS[sys.argv[1]](sys.argv[2:])
