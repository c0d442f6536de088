"""What each change reruns in a finished project, against what it should: the table of docs/runs.md.

    python benchmarks/increments.py [--project FOLDER]

Jobs are those that Snakemake plans. Cases are counted by their keys or, where a material changes,
by solving them. FOLDER keeps the finished project for the next time. Exit code 1 for a difference.
"""

from __future__ import annotations

import argparse
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "tests" / "workflow"))

from increments import (  # noqa: E402
    CHANGES,
    CONFIG,
    changed_copy,
    plan_all,
    run_change,
    summary,
    table,
    write_config,
)

from conftest import Project, copy_project, shorten_sheet  # noqa: E402 - a folder of tests


def finished(folder: Path) -> Path:
    """Run the pipeline in a copy of the project, unless it has already finished there."""
    if not (folder / "results/verdict.txt").exists():
        copy_project(folder)
        project = Project(folder)
        shorten_sheet(project)
        write_config(folder)
        run = project.snakemake(config=CONFIG)
        if run.returncode != 0:
            sys.exit(run.stderr[-4000:])
    return folder


def main() -> int:
    """Make each change in a copy, compare, print."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--project", type=Path, help="folder for the finished project")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="increments-") as base:
        project = finished((arguments.project or Path(base) / "finished").resolve())
        folders = {change.name: Path(base) / str(n) for n, change in enumerate(CHANGES)}
        for change in CHANGES:
            changed_copy(project, folders[change.name], change)
        planned = [change for change in CHANGES if not change.solves]
        plans = plan_all([folders[change.name] for change in planned])
        found = {
            c.name: summary(p["jobs"], p["cases"]) for c, p in zip(planned, plans, strict=True)
        }
        for change in CHANGES:
            if change.solves:
                found[change.name] = summary(*run_change(folders[change.name]))
    wrong = [change for change in CHANGES if found[change.name] != change.expected()]
    print(table())
    for change in wrong:
        print(f"{change.name}: found {found[change.name]}, expected {change.expected()}")
    print(f"{len(CHANGES)} changes, {len(wrong)} not as expected")
    return int(bool(wrong))


if __name__ == "__main__":
    sys.exit(main())
