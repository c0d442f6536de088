"""What a run costs besides its solvers: start, report, and every rule around the cases.

    python benchmarks/overhead.py [STUDY] [--runs 3] [--jobs 2]

STUDY is a folder in which this version's default study has finished (by default, this one); it is
copied and not touched. In the copy, in turn: ``snakemake --version``, a run with nothing to do, the
report alone with the figures that it keeps and with all figures drawn anew, and a run from the raw
files in which every case is known: everything that the default study does outside its solvers. A
study that is not finished, or was made by other code, is first brought up to date, which may take
as long as the study. Processor seconds also hold on a busy machine; wall seconds do not.
"""

from __future__ import annotations

import argparse
import csv
import shutil
import tempfile
from collections.abc import Callable
from pathlib import Path
from statistics import median

from commands import ROOT, Used, run

STORES = ("records", "spokes", "outlines")
"""What is solved and kept in results/5_solve: cases, tables of spokes, the spokes of one tyre."""


def project(study: Path, folder: Path) -> None:
    """Copy a finished study, with this checkout's inputs and code."""
    for name in ("config", "raw_data", "profiles", "workflow"):
        shutil.copytree(ROOT / name, folder / name, ignore=shutil.ignore_patterns("__pycache__"))
    shutil.copy(ROOT / "Snakefile", folder)
    for name in ("results", ".snakemake"):
        if (study / name).is_dir():
            left_out = shutil.ignore_patterns("locks", "log", "scripts", "runs")
            shutil.copytree(study / name, folder / name, ignore=left_out)


def forget_figures(folder: Path) -> None:
    """Remove the report and the figures that are kept for it."""
    forget_page(folder)
    shutil.rmtree(folder / "results/7_report", ignore_errors=True)


def forget_page(folder: Path) -> None:
    """Remove the report."""
    (folder / "results/report.html").unlink(missing_ok=True)


def forget_all_but_cases(folder: Path) -> None:
    """Remove what a run has made, except what solvers have stored."""
    results, kept = folder / "results", folder / "kept"
    kept.mkdir()
    for name in STORES:
        if (results / "5_solve" / name).is_dir():
            (results / "5_solve" / name).rename(kept / name)
    shutil.rmtree(results)
    results.mkdir()
    kept.rename(results / "5_solve")
    for name in ("metadata", "incomplete", "auxiliary"):
        shutil.rmtree(folder / ".snakemake" / name, ignore_errors=True)


def nothing(folder: Path) -> None:
    """Leave everything as it is."""


COMMANDS: dict[str, tuple[Callable[[Path], None], tuple[str, ...]]] = {
    "snakemake --version": (nothing, ("--version",)),
    "nothing to do": (nothing, ("-j{jobs}",)),
    "report alone, figures kept": (forget_page, ("-j{jobs}", "report")),
    "report alone, figures drawn": (forget_figures, ("-j{jobs}", "report")),
    "all, every case known": (forget_all_but_cases, ("-j{jobs}",)),
}
"""What is removed before each command, and its arguments."""


def row(name: str, one: Used, base: Used) -> str:
    """Write wall and processor time, and the ratios of both to those of ``--version``."""
    ratios = f"{one.wall_s / base.wall_s:9.2f}{one.cpu_s / base.cpu_s:9.2f}"
    failed = f"  exit code {one.code}" if one.code else ""
    return f"{name:30}{one.wall_s:9.1f}{one.cpu_s:9.1f}{ratios}{one.memory_mb:9.0f}{failed}"


def middle(used: list[Used]) -> Used:
    """Return the medians of several runs of a command."""
    wall, cpu = (median(getattr(one, what) for one in used) for what in ("wall_s", "cpu_s"))
    return Used(wall, cpu, max(one.memory_mb for one in used), max(one.code for one in used))


def solving_s(folder: Path) -> tuple[int, float]:
    """Return the number of cases and the sum of their wall times, when they were solved."""
    with (folder / "results/tables/cases.csv").open(encoding="utf-8", newline="") as stream:
        seconds = [float(case["wall_time_s"]) for case in csv.DictReader(stream)]
    return len(seconds), sum(seconds)


def main() -> None:
    """Print one row per command."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("study", nargs="?", type=Path, default=ROOT)
    parser.add_argument("--runs", type=int, default=3)
    parser.add_argument("--jobs", type=int, default=2)
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as name:
        folder, log = Path(name) / "project", Path(name) / "log"
        project(arguments.study, folder)
        first = run(["snakemake", f"-j{arguments.jobs}"], folder, log)
        if first.code:
            print(log.read_text(encoding="utf-8")[-2000:])
            return
        print(f"brought up to date in {first.wall_s:.1f} s", flush=True)
        used: dict[str, list[Used]] = {command: [] for command in COMMANDS}
        for _ in range(arguments.runs):
            for command, (prepare, words) in COMMANDS.items():
                prepare(folder)
                given = [word.format(jobs=arguments.jobs) for word in words]
                used[command].append(run(["snakemake", *given], folder))
                if "report" in words:  # the verdict depends on it
                    run(["snakemake", f"-j{arguments.jobs}"], folder)
        base = middle(used["snakemake --version"])
        print(f"{'command':30}{'wall s':>9}{'CPU s':>9}{'wall x':>9}{'CPU x':>9}{'MB':>9}")
        for command, of_command in used.items():
            print(row(command, middle(of_command), base))
        cases, seconds = solving_s(folder)
        print(f"solvers: {cases} cases, {seconds:.1f} s of wall time when they were solved")
        print(f"report: {(folder / 'results/report.html').stat().st_size / 1e6:.2f} MB")


if __name__ == "__main__":
    main()
