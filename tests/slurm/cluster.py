"""A Slurm cluster of two nodes on this machine, and the small study on it with a node killed.

    python tests/slurm/cluster.py start [--accounting]   # as root: installs, configures, starts
    python tests/slurm/cluster.py study FOLDER [--status sacct] [--config config/small.yaml]
    python tests/slurm/cluster.py stop

`start` installs Debian's slurm-wlm (with `--accounting` slurmdbd and MariaDB too) and writes
/etc/slurm; it refuses to replace the configuration of another cluster. `study` runs a study in two
copies of this repository in FOLDER, once on two local cores and once through `profiles/slurm`. In
the second run it kills node n2 with all that runs on it while a batch is solved there, and starts
it again once Slurm has noticed. It prints what happened when, and compares the tables of both runs
(`benchmarks/same_numbers.py`). The exit code is 0 if both runs succeeded, a node was killed under
a running batch, and all tables are the same.
"""

from __future__ import annotations

import argparse
import os
import shutil
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
ETC = Path("/etc/slurm")
MARK = "# Written by tests/slurm/cluster.py"
NODES = ("n1", "n2")
VICTIM = "n2"
BEGIN = time.monotonic()


def say(text: str) -> None:
    """Print a line with the time since the start."""
    print(f"[{time.monotonic() - BEGIN:6.1f} s] {text}", flush=True)


def run(*command: str, check: bool = True) -> str:
    """Run a command and return what it prints."""
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if check and done.returncode:
        raise SystemExit(f"{' '.join(command)}: exit code {done.returncode}\n{done.stderr}")
    return done.stdout.strip()


def wait_until(what: str, true: Callable[[], bool], seconds: float = 60.0) -> None:
    """Wait for a condition, and end with a message if it does not come true."""
    end = time.monotonic() + seconds
    while not true():
        if time.monotonic() > end:
            raise SystemExit(f"gave up after waiting {seconds:.0f} s until {what}")
        time.sleep(0.5)


def install(accounting: bool) -> None:
    """Install Debian's packages that are missing."""
    needed = {"slurmctld": "slurm-wlm", "munged": "munge"}
    if accounting:
        needed |= {"slurmdbd": "slurmdbd", "mariadbd": "mariadb-server"}
    missing = [package for program, package in needed.items() if shutil.which(program) is None]
    if missing:
        say(f"installing {', '.join(missing)}")
        run("apt-get", "update", "-qq")
        run("apt-get", "install", "-y", "-qq", "--no-install-recommends", *missing)


def configure(accounting: bool) -> None:
    """Write /etc/slurm for this host."""
    target = ETC / "slurm.conf"
    if target.exists() and not target.read_text().startswith(MARK):
        raise SystemExit(f"{target} belongs to another cluster; nothing was changed")
    ETC.mkdir(exist_ok=True)
    text = (HERE / "slurm.conf").read_text().replace("HOST", os.uname().nodename.split(".")[0])
    kind = "slurmdbd" if accounting else "none"
    text += f"AccountingStorageType=accounting_storage/{kind}\n"
    target.write_text(text)
    (ETC / "cgroup.conf").write_text("CgroupPlugin=cgroup/v1\nCgroupAutomount=no\n")
    if accounting:
        shutil.copy(HERE / "slurmdbd.conf", ETC / "slurmdbd.conf")
        (ETC / "slurmdbd.conf").chmod(0o600)


def start(accounting: bool) -> None:
    """Start the cluster."""
    install(accounting)
    configure(accounting)
    for folder in ("/var/spool/slurmctld", *(f"/var/spool/slurmd.{node}" for node in NODES)):
        Path(folder).mkdir(parents=True, exist_ok=True)
    Path("/run/munge").mkdir(exist_ok=True)
    shutil.chown("/run/munge", "munge", "munge")
    if not answers("munge", "-n"):
        run("runuser", "-u", "munge", "--", "/usr/sbin/munged")
        wait_until("munge answers", lambda: answers("munge", "-n"))
    if accounting:
        start_accounting()
    run("slurmctld", "-c")  # forget earlier jobs
    wait_until("slurmctld answers", lambda: answers("scontrol", "ping"))
    for node in NODES:
        run("slurmd", "-N", node)
    wait_until("both nodes are idle", lambda: run("sinfo", "-h", "-t", "idle", "-o", "%D") == "2")
    say(run("sinfo", "-N", "-o", "%N %T %c %m") + ("\naccounting" if accounting else ""))


def answers(*command: str) -> bool:
    """Tell whether a command succeeds."""
    return subprocess.run(command, capture_output=True, check=False).returncode == 0


def start_accounting() -> None:
    """Start MariaDB and slurmdbd, and register the cluster and this user."""
    Path("/run/mysqld").mkdir(exist_ok=True)
    shutil.chown("/run/mysqld", "mysql", "mysql")
    if not answers("mariadb-admin", "ping"):
        database = ("mariadbd", "--user=mysql", "--skip-networking")
        subprocess.Popen(
            database, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True
        )
        wait_until("MariaDB answers", lambda: answers("mariadb-admin", "ping"))
    run("mariadb", "-e", "CREATE DATABASE IF NOT EXISTS slurm_acct_db")
    run("slurmdbd")
    wait_until("slurmdbd answers", lambda: answers("sacctmgr", "-n", "list", "cluster"))
    if "twonodes" not in run("sacctmgr", "-n", "list", "cluster", "format=cluster%20"):
        run("sacctmgr", "-i", "add", "cluster", "twonodes")
        run("sacctmgr", "-i", "add", "account", "lab", "cluster=twonodes")
        run("sacctmgr", "-i", "add", "user", os.environ.get("USER", "root"), "account=lab")


def stop() -> None:
    """Stop everything that `start` has started."""
    run("scontrol", "shutdown", check=False)
    files = ("slurmdbd", "mysqld/mysqld", "munge/munged", *(f"slurmd.{node}" for node in NODES))
    for file in files:
        path = Path(f"/run/{file}.pid")
        if path.exists():
            try:
                os.kill(int(path.read_text()), signal.SIGTERM)
            except ProcessLookupError:
                continue
    say("stopped")


def processes_of(node: str) -> dict[int, bytes]:
    """Find the processes of a node with their commands: its daemons first, then what they run."""
    parents: dict[int, int] = {}
    commands: dict[int, bytes] = {}
    tasks: list[int] = []
    for folder in Path("/proc").iterdir():
        if not folder.name.isdigit():
            continue
        try:
            environment = (folder / "environ").read_bytes().split(b"\0")
            command = (folder / "cmdline").read_bytes()
            parent = int((folder / "stat").read_text().rsplit(")", 1)[1].split()[1])
        except (OSError, IndexError):
            continue
        number = int(folder.name)
        parents[number], commands[number] = parent, command
        if f"SLURMD_NODENAME={node}".encode() in environment:
            tasks.append(number)
    steps = {parents[task] for task in tasks}
    steps = {step for step in steps if commands.get(step, b"").startswith(b"slurmstepd")}
    daemon = int(Path(f"/run/slurmd.{node}.pid").read_text())
    return {number: commands.get(number, b"") for number in [daemon, *steps, *tasks]}


def kill_node(node: str) -> None:
    """End a node as a power failure would: all its processes at once."""
    count = 0
    for process in processes_of(node):
        try:
            os.kill(process, signal.SIGKILL)
            count += 1
        except ProcessLookupError:
            continue
    say(f"killed node {node}: {count} processes")


def jobs(*columns: str) -> list[list[str]]:
    """Return these columns of squeue for all jobs, finished ones too."""
    lines = run("squeue", "-h", "--states=all", "-o", "|".join(columns), check=False).splitlines()
    return [line.split("|") for line in lines]


def copy_repository(target: Path) -> None:
    """Copy what git tracks, as it is now."""
    for name in run("git", "-C", str(ROOT), "ls-files", "-z").split("\0"):
        if name and (ROOT / name).is_file():
            (target / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(ROOT / name, target / name)


def snakemake(folder: Path, log: str, *arguments: str) -> subprocess.Popen[bytes]:
    """Start Snakemake in a copy of the repository."""
    environment = {**os.environ, "PYTHONPATH": str(folder / "workflow" / "src")}
    command = [sys.executable, "-m", "snakemake", *arguments]
    with (folder / log).open("wb") as stream:
        return subprocess.Popen(
            command, cwd=folder, env=environment, stdout=stream, stderr=subprocess.STDOUT
        )


class Watch:
    """Follow a run through Slurm: print what changes, kill the victim, start it again."""

    def __init__(self, solver: str, least_s: float) -> None:
        self.solver, self.least_s = solver, least_s
        self.since = 0.0
        self.before = {job for [job] in jobs("%i")}
        self.known: dict[str, str] = {}
        self.killed = self.restarted = False

    def look(self) -> None:
        """Look once at the queue and at the nodes."""
        for job, node, state, rule in jobs("%i", "%N", "%T", "%k"):
            if job in self.before:
                continue
            text = f"job {job} {rule}: {state} {node}"
            if self.known.get(job) != text:
                say(text)
                self.known[job] = text
            if node == VICTIM and state == "RUNNING" and self.solver in rule and not self.killed:
                self.kill_if_it_solves(job)
        dead = "down" in run("sinfo", "-h", "-n", VICTIM, "-o", "%T", check=False)
        if self.killed and dead and not self.restarted:
            say(f"Slurm has noticed: {run('sinfo', '-h', '-N', '-o', '%N is %T (%E)')}")
            run("slurmd", "-N", VICTIM)
            self.restarted = True

    def kill_if_it_solves(self, job: str) -> None:
        """Kill the victim when the script of a batch has run on it for some seconds."""
        if not any(b".solve.py" in command for command in processes_of(VICTIM).values()):
            return
        self.since = self.since or time.monotonic()
        if time.monotonic() - self.since >= self.least_s:
            say(f"job {job} has been solving cases on {VICTIM} for {self.least_s:.0f} s or more")
            kill_node(VICTIM)
            self.killed = True

    def follow(self, process: subprocess.Popen[bytes]) -> int:
        """Look every second until Snakemake ends; return its exit code."""
        while process.poll() is None:
            self.look()
            time.sleep(1.0)
        self.look()
        return process.returncode


def study(
    folder: Path,
    status: str,
    config: str,
    solver: str,
    least_s: float,
    minutes_per_batch: float,
    only_cases: bool,
) -> int:
    """Run a study locally and through Slurm, and compare."""
    local, cluster = folder / "local", folder / "cluster"
    given = ("--configfile", config)
    if not (local / "results" / "verdict.txt").exists():
        copy_repository(local)
        say("local run begins")
        code = snakemake(local, "run.log", "-j2", *given).wait()
        say(f"local run ends with exit code {code}")
        if code:
            return code
    left_out = ("5_solve",) if only_cases else ("results", ".snakemake")
    shutil.copytree(local, cluster, ignore=shutil.ignore_patterns(*left_out))
    say(f"run through Slurm begins, status by {status}")
    process = snakemake(
        cluster,
        "run.log",
        *("--workflow-profile", "profiles/slurm", "--slurm-status-command", status),
        *("--slurm-init-seconds-before-status-checks", "5", "--slurm-keep-successful-logs"),
        *("--config", f"campaign={{minutes_per_batch: {minutes_per_batch}}}"),
        *given,
    )
    watch = Watch(solver, least_s)
    code = watch.follow(process)
    say(f"run through Slurm ends with exit code {code}")
    if status == "sacct":
        fields = "JobID%-12,State%-12,NodeList,Elapsed,MaxRSS,ReqMem,ReqCPUS"
        print(run("sacct", "-D", "--format", fields, check=False), flush=True)
    compare = [sys.executable, str(ROOT / "benchmarks" / "same_numbers.py")]
    same = subprocess.run([*compare, str(local), str(cluster)], check=False)
    if not watch.killed:
        say("no batch ran on the node long enough to be killed")
    return code or same.returncode or int(not watch.killed)


def main() -> int:
    """Read the command line."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parts = parser.add_subparsers(required=True, dest="part")
    starting = parts.add_parser("start")
    starting.add_argument("--accounting", action="store_true")
    studying = parts.add_parser("study")
    studying.add_argument("folder", type=Path)
    studying.add_argument("--status", choices=("squeue", "sacct"), default="squeue")
    studying.add_argument("--config", default="config/small.yaml")
    studying.add_argument("--kill", default="fe_tyre", help="solver under which the node dies")
    studying.add_argument(
        "--kill-after",
        type=float,
        default=5.0,
        help="seconds for which its batch has been solving by then",
    )
    studying.add_argument(
        "--minutes-per-batch",
        type=float,
        default=0.1,
        help="CPU time for which batches are sized; more for a study of many cases",
    )
    studying.add_argument(
        "--only-cases",
        action="store_true",
        help="take what comes before the cases from the local run",
    )
    parts.add_parser("stop")
    chosen = parser.parse_args()
    if chosen.part == "start":
        start(chosen.accounting)
    elif chosen.part == "stop":
        stop()
    else:
        given = (chosen.status, chosen.config, chosen.kill, chosen.kill_after)
        batches = (chosen.minutes_per_batch, chosen.only_cases)
        return study(chosen.folder.resolve(), *given, *batches)
    return 0


if __name__ == "__main__":
    sys.exit(main())
