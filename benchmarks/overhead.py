"""What a run costs besides its solvers: start, report, and every rule around the cases.

    python benchmarks/overhead.py [--runs 3] [--jobs 2]

All figures come from one call. The default study is run in a fresh folder with those of its solvers
that take milliseconds (`published`, `lca`), so that what is measured is everything else; then, in
turn, ``snakemake --version``, a run with nothing to do and the report alone, with and without the
figures that it keeps. Processor seconds hold on a busy machine, too; wall seconds are of the same
minutes.
"""

from __future__ import annotations

import argparse
import shutil
import tempfile
from pathlib import Path
from statistics import median

import yaml
from commands import ROOT, Used, run

QUICK = ("published", "lca")
PAGES = ("report.html", "workbook.xlsx", "verdict.txt")


def project(folder: Path) -> None:
    """Make a project folder whose studies have the quick solvers only."""
    for name in ("config", "raw_data", "profiles", "workflow"):
        shutil.copytree(ROOT / name, folder / name, ignore=shutil.ignore_patterns("__pycache__"))
    config = folder / "config/config.yaml"
    values = yaml.safe_load(config.read_text(encoding="utf-8"))
    studies = []
    for study in values["studies"]:
        quick = [name for name in study["solvers"] if name in QUICK]
        if quick:
            dropped = {
                *("calibration_cases", "published_spoke_stiffness", "decisions", "responses"),
            }
            kept = {key: value for key, value in study.items() if key not in dropped}
            options = study.get("solver_options", {})
            kept["solver_options"] = {key: options[key] for key in quick if key in options}
            studies.append({**kept, "solvers": quick})
    values["studies"] = studies
    config.write_text(yaml.safe_dump(values, sort_keys=False), encoding="utf-8")


def report_alone(folder: Path, jobs: str, keep_figures: bool) -> Used:
    """Build the report again, from the tables that are there."""
    for name in PAGES:
        (folder / "results" / name).unlink(missing_ok=True)
    if not keep_figures:
        shutil.rmtree(folder / "results/7_report", ignore_errors=True)
    return run(["snakemake", jobs, "results/report.html"], folder)


def row(name: str, used: list[Used], base: float) -> str:
    """Write medians of wall and processor time, and the latter over that of ``--version``."""
    wall, cpu = (median(getattr(one, what) for one in used) for what in ("wall_s", "cpu_s"))
    memory = max(one.memory_mb for one in used)
    failed = f"  exit codes {[one.code for one in used]}" if any(one.code for one in used) else ""
    return f"{name:34}{wall:9.1f}{cpu:9.1f}{cpu / base:9.2f}{memory:9.0f}{failed}"


def main() -> None:
    """Print one row per command."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--runs", type=int, default=3)
    parser.add_argument("--jobs", type=int, default=2)
    arguments = parser.parse_args()
    jobs = f"-j{arguments.jobs}"
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name) / "project"
        project(folder)
        whole = run(["snakemake", jobs], folder, Path(name) / "log")
        if whole.code:
            print((Path(name) / "log").read_text()[-2000:])
        rows: dict[str, list[Used]] = {}
        for _ in range(arguments.runs):
            rows.setdefault("snakemake --version", []).append(
                run(["snakemake", "--version"], folder)
            )
            rows.setdefault("nothing to do", []).append(run(["snakemake", jobs], folder))
            rows.setdefault("report, figures drawn", []).append(report_alone(folder, jobs, False))
            rows.setdefault("report, figures kept", []).append(report_alone(folder, jobs, True))
            run(["snakemake", jobs], folder)
        base = median(one.cpu_s for one in rows["snakemake --version"])
        size = (folder / "results/report.html").stat().st_size / 1e6
        print(f"{'command':34}{'wall s':>9}{'CPU s':>9}{'ratio':>9}{'MB':>9}")
        for name_of, used in rows.items():
            print(row(name_of, used, base))
        print(row("all, quick solvers", [whole], base))
        print(f"report: {size:.2f} MB")


if __name__ == "__main__":
    main()
