"""What the commands of the docs need next to a followed tutorial: a study of seconds, stand-ins."""

from __future__ import annotations

import os
import shlex
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
STAND_INS = {
    "abaqus": ["abaqus"],
    "slurm": ["sbatch", "srun", "sacct", "sinfo", "scontrol"],
}
"""Commands that take the place of programs that are not here, by their file in `programs`."""


COARSE = {
    "config/solvers/fe.py": {
        "(1, 2, 4, 1, 1, 1),": "(1, 1, 1, 1, 1, 1),",
        "gap_columns: int = Field(2,": "gap_columns: int = Field(1,",
        "(-40.0, 8.0),": "(-24.0, 6.0),",
        "(7, 3, 3),": "(4, 3, 3),",
        "(11, 5), description": "(5, 4), description",
        "around: int = Field(PAPER_COLUMNS,": "around: int = Field(120,",
        "load_steps: int = Field(10,": "load_steps: int = Field(2,",
    },
    "fe/spoke/pull.py": {
        "tension_steps: int = 8, compression_steps: int = 10": "tension_steps: int = 2, "
        "compression_steps: int = 4",
    },
}
"""Defaults of the finite elements, and what `coarsen` puts in their place."""


def complete(tree: Path) -> None:
    """Add what `make` and `pre-commit` need; of the tests, only a few."""
    for name in (*FILES, ".pre-commit-config.yaml"):
        shutil.copy2(ROOT / name, tree / name)
    (tree / FEW_TESTS).parent.mkdir(parents=True)
    shutil.copy2(ROOT / FEW_TESTS, tree / FEW_TESTS)
    subprocess.run(["git", "init", "-q"], cwd=tree, check=True)
    for file, commands in STAND_INS.items():
        for command in commands:
            stand_in(tree / "programs" / command, file)


def stand_in(command: Path, file: str) -> None:
    """Write a command that starts a file of `programs`, which gets the name if it has several."""
    command.parent.mkdir(exist_ok=True)
    words = [sys.executable, str(Path(__file__).with_name("programs") / f"{file}.py")]
    if len(STAND_INS[file]) > 1:
        words.append(command.name)
    jobs = shlex.quote(str(command.parents[1] / "jobs"))
    line = f'STAND_IN_JOBS={jobs} exec {shlex.join(words)} "$@"'
    command.write_text(f"#!/bin/sh\n{line}\n", encoding="utf-8")
    command.chmod(0o755)


def submitted(tree: Path) -> list[str]:
    """Return the words of each submission to the stand-in for Slurm."""
    return (tree / "jobs/submitted.txt").read_text("utf-8").splitlines()


def states(tree: Path) -> list[str]:
    """Return the states of its jobs in the order of their numbers."""
    files = sorted((tree / "jobs").glob("*/state"), key=lambda file: int(file.parent.name))
    return [file.read_text("utf-8").strip() for file in files]


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


def coarsen(tree: Path) -> None:
    """Give the finite elements of a copy of the package the coarsest meshes and tables that work.

    For a command that reads no configuration, and so takes the defaults.
    """
    for file, numbers in COARSE.items():
        path = tree / "workflow/src/nptcs" / file
        text = path.read_text("utf-8")
        for default, coarse in numbers.items():
            assert text.count(default) == 1, f"{file}: {default!r} is there {text.count(default)}×"
            text = text.replace(default, coarse)
        path.write_text(text, encoding="utf-8")


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
            [str(tree / "programs"), str(Path(sys.executable).parent), os.environ["PATH"]]
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
