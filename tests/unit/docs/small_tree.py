"""What the commands of the docs need next to a followed tutorial: a study of seconds, a queue."""

from __future__ import annotations

import os
import shutil
import site
import subprocess
import sys
from pathlib import Path
from typing import Any

import yaml

ROOT = Path(__file__).parents[3]
FILES = ("Makefile", "Snakefile", "pyproject.toml", "constraints.txt", "README.md", "LICENSE")
FEW_TESTS = "tests/unit/test_yaml_files.py"
QUEUE = """#!/bin/sh
# a stand-in for a queue: it starts the job at once and prints the number of its process
echo "$*" >> submitted.txt
for script; do :; done
sh "$script" > job.log 2>&1 &
echo $!
"""


def complete(tree: Path) -> None:
    """Add what `make` and `pre-commit` need; of the tests, only a few."""
    for name in (*FILES, ".pre-commit-config.yaml"):
        shutil.copy2(ROOT / name, tree / name)
    (tree / FEW_TESTS).parent.mkdir(parents=True)
    shutil.copy2(ROOT / FEW_TESTS, tree / FEW_TESTS)
    subprocess.run(["git", "init", "-q"], cwd=tree, check=True)
    queue = tree / "queue" / "sbatch"
    queue.parent.mkdir()
    queue.write_text(QUEUE, encoding="utf-8")
    queue.chmod(0o755)


def shorten(tree: Path) -> None:
    """Replace the default study by the tutorial's and one of rubbers, and shrink the joint one."""
    config = read(ROOT / "config/config.yaml")
    small = read(tree / "config/tutorial.yaml")
    rubber = next(study for study in config["studies"] if study["name"] == "rubber")
    rubber |= {"solvers": ["published", "lca"], "surfaces": [], "responses": []}
    del rubber["neutral_line_cases"]
    merge(config, {**small, "studies": [*small["studies"], rubber]})
    write(tree / "config/config.yaml", config)
    joint = read(ROOT / "config/joint.yaml")
    study = joint["further_studies"][0]
    study["design"] |= {"whole_plots": 3, "cases_per_plot": 2, "corners": False}
    study |= {"terms": study["terms"][:2], "surfaces": [], "responses": []}
    coarse = small["solvers"]["fe_tyre"]
    merge(
        joint["solvers"]["ring"],
        {name: coarse[name] for name in ("spoke_mesh", "table", "load_steps")},
    )
    write(tree / "config/joint.yaml", joint)


def merge(into: dict[str, Any], other: dict[str, Any]) -> None:
    """Put one mapping on top of another, as Snakemake does with `--configfile`."""
    for key, value in other.items():
        if isinstance(value, dict) and isinstance(into.get(key), dict):
            merge(into[key], value)
        else:
            into[key] = value


def read(path: Path) -> dict[str, Any]:
    return yaml.safe_load(path.read_text("utf-8"))


def write(path: Path, values: dict[str, Any]) -> None:
    path.write_text(yaml.safe_dump(values, sort_keys=False), encoding="utf-8")


def shell(lines: list[str], tree: Path, code: int = 0, **variables: str) -> str:
    """Run lines as one script of the shell, with the package of `tree`; return what it printed.

    pip may fetch nothing: it installs from the tree and finds the rest in the environment that
    runs the tests.
    """
    environment = {
        **os.environ,
        "PATH": os.pathsep.join(
            [str(tree / "queue"), str(Path(sys.executable).parent), os.environ["PATH"]]
        ),
        "PYTHONPATH": os.pathsep.join([str(tree / "workflow/src"), *site.getsitepackages()]),
        "PIP_NO_INDEX": "1",
        "PIP_NO_BUILD_ISOLATION": "off",
        "OPENBLAS_NUM_THREADS": "1",
        **variables,
    }
    done = subprocess.run(
        ["bash", "-ec", "\n".join(lines)],
        cwd=tree,
        env=environment,
        capture_output=True,
        text=True,
        check=False,
    )
    printed = done.stdout + done.stderr
    assert done.returncode == code, f"{lines}: exit code {done.returncode}\n{printed[-6000:]}"
    return printed
