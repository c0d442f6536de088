"""Runs that are killed at random moments, and the same command again: what is lost or left behind.

    python benchmarks/kill_trials.py [--trials 200] [--seed 1]

A small study of a stub solver, which runs a command for each case, is started by Snakemake and hit:
SIGKILL to the whole process group, to Snakemake alone, to the host of the scripts, to the script of
the rule, to the process of a case, to the solver's command; SIGTERM and SIGINT to Snakemake. After
some such trials the same command runs to completion, and its table is compared with that of an
undisturbed run.

Exit code 1 if anything was half written, lost, solved twice, left behind, or had to be mended by
hand.
"""

from __future__ import annotations

import argparse
import csv
import os
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path

import psutil
import yaml

from nptcs.campaign.record import CaseRecord, read_records
from nptcs.errors import InputError
from nptcs.files import UNFINISHED, read_model

ROOT = Path(__file__).resolve().parents[1]
CASES = 40
SOLVER = '''
"""Stub: a command that takes a moment, a temporary file, an exact result."""
import sys, tempfile
from pathlib import Path
from nptcs.solvers.contract import Solver, SolverResult, Status
from nptcs.solvers.external import run_command

def solve(inputs):
    c = inputs.values["spoke_c10_mpa"]
    with tempfile.TemporaryDirectory(prefix="stub-") as folder:
        run_command(["sleep", "0.5"], Path(folder), 60.0)
    curve = {"displacement_mm": [0.0, c], "force_n": [0.0, 3.0 * c]}
    return SolverResult(status=Status.OK, vertical_stiffness_n_per_mm=100.0 + c,
                        displacement_mm=inputs.load_n / (100.0 + c), curve=curve)

SOLVER = Solver("stub", "1", solve, frozenset({"spoke_c10_mpa"}), about="a stub")
'''
TARGET = "results/tables/cases.csv"
BATCH = "results/5_solve/killed/stub/batch_1.jsonl"
VICTIMS = ("group", "Snakemake", "host", "script", "case", "command", "SIGTERM", "SIGINT")
HITS = {"case": 4, "command": 4}
"""Hits in one run, which goes on after them; any other hit ends its run."""
WITHIN_S = 5.0


@dataclass
class Count:
    """What the trials of one kind of victim showed."""

    trials: int = 0
    missed: int = 0
    slowest_end_s: float = 0.0
    outlived: int = 0
    half_written: int = 0
    lost: int = 0
    solved_twice: int = 0
    left_in_temp: int = 0
    by_hand: int = 0
    notes: list[str] = field(default_factory=list)

    def faults(self) -> int:
        """Add up what must not happen."""
        return (
            self.outlived
            + self.half_written
            + self.lost
            + self.solved_twice
            + self.left_in_temp
            + self.by_hand
        )


class Project:
    """A folder in which a small study runs, with a temporary folder of its own."""

    def __init__(self, folder: Path, earlier: Path | None = None) -> None:
        self.folder, self.temp = folder, folder / "temp"
        self.temp.mkdir(parents=True)
        (folder / "raw_data").symlink_to(ROOT / "raw_data")
        (folder / "config").mkdir()
        (folder / "config/formats").symlink_to(ROOT / "config/formats")
        (folder / "stub.py").write_text(SOLVER)
        levels = [1.0 + number for number in range(CASES)]
        factor = {"name": "spoke_c10_mpa", "label": "C10", "unit": "MPa", "levels": levels}
        study = {"name": "killed", "title": "t", "factors": [factor], "solvers": ["stub"]}
        config = {"studies": [study], "solvers": {"stub": {"module": "stub.py"}}}
        (folder / "config/config.yaml").write_text(yaml.safe_dump(config))
        if earlier is not None:  # what a start has found out is known, as after any earlier run
            known = Path(".snakemake/nptcs/start.json")
            (folder / known).parent.mkdir(parents=True)
            shutil.copy(earlier / known, folder / known)

    def start(self) -> subprocess.Popen[bytes]:
        """Start the run; always the same command."""
        command = [
            *(sys.executable, "-m", "snakemake", "-s", str(ROOT / "workflow/Snakefile")),
            *("-d", str(self.folder), "-j2", "--workflow-profile", "none", "--rerun-incomplete"),
            *("--scheduler", "greedy", "--", TARGET),
        ]
        environment = {
            **os.environ,
            "PYTHONPATH": str(ROOT / "workflow" / "src"),
            "TMPDIR": str(self.temp),
            "OPENBLAS_NUM_THREADS": "1",
        }
        log = (self.folder / "run.log").open("ab")
        with log:
            log.write(f"\n=== run at {time.time():.3f}\n".encode())
            log.flush()
            return subprocess.Popen(
                command,
                cwd=self.folder,
                env=environment,
                stdin=subprocess.DEVNULL,
                stdout=log,
                stderr=log,
                start_new_session=True,
            )

    def records(self) -> dict[Path, int]:
        """Return the stored records and their dates."""
        store = self.folder / "results/5_solve/records"
        return {file: file.stat().st_mtime_ns for file in store.glob("??/[0-9a-f]*.json")}

    def last_log(self) -> str:
        """Return what the last run printed."""
        text = (self.folder / "run.log").read_text(encoding="utf-8", errors="replace")
        return text.rpartition("\n=== run at ")[2]

    def unsound(self) -> list[str]:
        """Name the files of results that cannot be read."""
        bad = []
        for file in self.records():
            try:
                read_model(file, CaseRecord)
            except InputError:
                bad.append(file.name)
        if (self.folder / BATCH).exists():
            try:
                read_records([str(self.folder / BATCH)])
            except InputError:
                bad.append(BATCH)
        return bad

    def table(self) -> str:
        """Return the table of cases without their wall times."""
        with (self.folder / TARGET).open(encoding="utf-8", newline="") as stream:
            rows = list(csv.DictReader(stream))
        return "\n".join(
            ",".join(value for name, value in row.items() if name != "wall_time_s") for row in rows
        )


def family(process: subprocess.Popen[bytes]) -> list[psutil.Process]:
    """Return a run and all its descendants."""
    try:
        root = psutil.Process(process.pid)
        return [root, *root.children(recursive=True)]
    except psutil.Error:
        return []


def of_kind(members: list[psutil.Process]) -> dict[str, list[psutil.Process]]:
    """Sort the processes of a run by what they do."""
    kinds: dict[str, list[psutil.Process]] = {name: [] for name in VICTIMS}
    kinds["Snakemake"] = kinds["group"] = kinds["SIGTERM"] = kinds["SIGINT"] = members[:1]
    for member in members[1:]:
        try:
            line, parents = " ".join(member.cmdline()), member.parents()
            above = " ".join(parents[0].cmdline()) if parents else ""
        except psutil.Error:
            continue
        if line.startswith("sleep"):
            kinds["command"].append(member)
        elif "forkserver" in line and "forkserver" in above:
            kinds["case"].append(member)
        elif "script_host.py" in line:  # a script is a fork of its host
            kinds["script" if "script_host.py" in above else "host"].append(member)
    return kinds


def hit(project: Project, victim: str, moment: Callable[[float, int], bool], count: Count) -> None:
    """Start a run, hit it at a moment, and examine what is left afterwards."""
    before = project.records()
    run, began = project.start(), time.monotonic()
    members: list[psutil.Process] = []
    struck, ended = 0, began
    while run.poll() is None and struck < HITS.get(victim, 1):
        if moment(time.monotonic() - began, len(project.records()) - len(before)):
            members = family(run)
            ended = time.monotonic()
            if strike(run, victim, of_kind(members)):
                struck += 1
                time.sleep(0.3 if victim in HITS else 0.0)
        time.sleep(0.02)
    count.trials += struck
    count.missed += not struck
    if victim in HITS or victim in ("host", "script") or not struck:
        run.wait()
    else:
        _, left = psutil.wait_procs(members[1:], timeout=3 * WITHIN_S)
        took = time.monotonic() - ended
        run.wait()
        count.slowest_end_s = max(count.slowest_end_s, took)
        count.outlived += bool(left) or took > WITHIN_S
    settle(project)
    examine(project, before, count)


def strike(
    run: subprocess.Popen[bytes],
    victim: str,
    kinds: dict[str, list[psutil.Process]],
) -> bool:
    """Send the signal; return False if there is no such process at this moment."""
    if not kinds[victim]:
        return False
    chosen = random.choice(kinds[victim])
    try:
        if victim == "group":
            os.killpg(run.pid, signal.SIGKILL)
        elif victim in ("SIGTERM", "SIGINT"):
            chosen.send_signal(signal.Signals[victim])
        else:
            chosen.kill()
    except (psutil.Error, ProcessLookupError):
        return False
    return True


def settle(project: Project) -> None:
    """Give the warden its time to clean up."""
    end = time.monotonic() + WITHIN_S
    while leftovers(project) and time.monotonic() < end:
        time.sleep(0.05)


def leftovers(project: Project) -> list[Path]:
    """Name what is in the temporary folder, except what Snakemake's next run removes."""
    return sorted(project.temp.glob("[!s]*"))


def examine(project: Project, before: dict[Path, int], count: Count) -> None:
    """Count what is wrong after a hit."""
    after = project.records()
    count.half_written += len(project.unsound())
    count.lost += len(set(before) - set(after))
    count.solved_twice += sum(after.get(file, date) != date for file, date in before.items())
    left = leftovers(project)
    count.left_in_temp += bool(left)
    count.notes += [f"left: {path.name}" for path in left]
    text = project.last_log()
    if "cannot be locked" in text or "LockException" in text:
        count.by_hand += 1
        count.notes.append("lock")
    for path in left:
        shutil.rmtree(path, ignore_errors=True)


def moments(seed: random.Random) -> Iterator[Callable[[float, int], bool]]:
    """Yield moments: some while cases are solved, some at any time from the first second on."""
    while True:
        solved, seconds = seed.randint(0, 6), seed.uniform(0.3, 12.0)
        if seed.random() < 0.7:
            yield lambda _, new, solved=solved: new >= solved + 1
        else:
            yield lambda passed, _, seconds=seconds: passed >= seconds


def chains_of(trials: int, seed: random.Random) -> list[list[str]]:
    """Return what to hit in the runs of each project, so that the hits add up to the trials.

    A run whose cases are hit solves all that is left; so it is the last of its project.
    """
    chains: list[list[str]] = []
    hits = 0
    while hits < trials:
        ending = [victim for victim in VICTIMS if victim not in HITS]
        seed.shuffle(ending)
        last = sorted(HITS)[len(chains) % len(HITS)]
        chains.append([*ending, last])
        hits += sum(HITS.get(victim, 1) for victim in chains[-1])
    return chains


def chain(
    project: Project, victims: list[str], counts: dict[str, Count], when: Iterator
) -> tuple[bool, str]:
    """Hit runs of one project, then let one end; return whether it did, and its table."""
    for victim in victims:
        hit(project, victim, next(when), counts[victim])
        print(f"{victim}: {len(project.records())} of {CASES} solved", flush=True)
    ended = project.start().wait() == 0
    if not ended:
        print(project.last_log()[-2000:])
        return False, ""
    stray = [*(project.folder / "results").rglob(f"{UNFINISHED}*"), *project.temp.iterdir()]
    for path in stray:
        print(f"left at the end: {path.name}")
    return not stray, project.table()


def main() -> int:
    """Run the trials and print what they showed."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--trials", type=int, default=200)
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    signal.signal(signal.SIGINT, signal.default_int_handler)  # otherwise ignored in the background
    seed = random.Random(arguments.seed)
    random.seed(arguments.seed)
    counts = {victim: Count() for victim in VICTIMS}
    chains = chains_of(arguments.trials, seed)
    when, ends, equal = moments(seed), 0, 0
    with tempfile.TemporaryDirectory(prefix="kill-trials-") as base:
        undisturbed = Project(Path(base) / "undisturbed")
        if undisturbed.start().wait() != 0:
            print(undisturbed.last_log())
            return 1
        wanted = undisturbed.table()
        bad = 0
        for number, victims in enumerate(chains):
            project = Project(Path(base) / f"project {number}", undisturbed.folder)
            ended, table = chain(project, victims, counts, when)
            ends += ended
            equal += table == wanted
            if ended and table == wanted:
                shutil.rmtree(project.folder)
            bad = report(counts, ends, equal, number + 1)
    return bad


def report(counts: dict[str, Count], ends: int, equal: int, chains: int) -> int:
    """Print the counts so far as a table; 1 if anything is wrong."""
    print(
        "\n| hit | trials | children gone after at most | half written | lost | solved twice",
        end="",
    )
    print(" | left in the temporary folder | lock in the way |")
    print("|---|---|---|---|---|---|---|---|")
    for victim, count in counts.items():
        words = f"{count.slowest_end_s:.1f} s" if count.slowest_end_s else "-"
        print(
            f"| {victim} | {count.trials} | {words} | {count.half_written} | {count.lost} | "
            f"{count.solved_twice} | {count.left_in_temp} | {count.by_hand} |"
        )
        for note in sorted(set(count.notes)):
            print(f"  {victim}: {note}")
    missed = sum(count.missed for count in counts.values())
    print(f"runs that ended before their hit: {missed}")
    print(f"projects that the same command brought to an end: {ends} of {chains}")
    print(f"tables equal byte for byte but for the wall times: {equal} of {chains}")
    return int(any(count.faults() for count in counts.values()) or min(ends, equal) < chains)


if __name__ == "__main__":
    sys.exit(main())
