"""The package works as a wheel, with no repository next to it."""

import pickle
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from nptcs.report.html import render_report

ROOT = Path(__file__).parents[3]
PACKAGE = Path("workflow/src/nptcs")

RENDER = """
import pathlib, pickle, sys
folder, results, page = map(pathlib.Path, sys.argv[1:])
sys.path.insert(0, str(folder))
import nptcs
assert pathlib.Path(nptcs.__file__).is_relative_to(folder), nptcs.__file__
from nptcs.report.html import render_report
page.write_text(render_report(pickle.loads(results.read_bytes())), encoding="utf-8")
"""

COMMAND = """
import importlib.metadata, sys
folder, *sys.argv[1:] = sys.argv[1:]
sys.path.insert(0, folder)
(distribution,) = importlib.metadata.distributions(name="nptcs", path=[folder])
(entry,) = distribution.entry_points.select(group="console_scripts", name="nptcs")
main = entry.load()
assert sys.modules["nptcs"].__file__.startswith(folder)
sys.exit(main())
"""

EVERY_MODULE = """
import importlib, pkgutil, sys
sys.path.insert(0, sys.argv[1])
import nptcs
for found in pkgutil.walk_packages(nptcs.__path__, "nptcs."):
    importlib.import_module(found.name)
"""


def run(*command, **options):
    done = subprocess.run(command, capture_output=True, text=True, check=False, **options)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


def run_isolated(folder, code, *arguments):
    """Run code that sees the installed package and not the repository."""
    return run(sys.executable, "-I", "-c", code, str(folder), *map(str, arguments), cwd=folder)


@pytest.fixture(scope="module")
def installed(tmp_path_factory):
    """Build the wheel from a copy of the tree and install it into its own folder."""
    tree = tmp_path_factory.mktemp("tree")
    for name in ("pyproject.toml", "README.md", "LICENSE"):
        shutil.copy(ROOT / name, tree)
    leave = shutil.ignore_patterns("__pycache__", "*.egg-info")
    shutil.copytree(ROOT / PACKAGE, tree / PACKAGE, ignore=leave)
    pip = (sys.executable, "-m", "pip", "--disable-pip-version-check")
    offline = ("--no-deps", "--no-index", "--no-build-isolation")
    run(*pip, "wheel", *offline, "--wheel-dir", str(tree), ".", cwd=tree)
    (wheel,) = tree.glob("nptcs-*.whl")
    folder = tmp_path_factory.mktemp("installed")
    run(*pip, "install", *offline, "--no-compile", "--target", str(folder), str(wheel), cwd=tree)
    return folder


def files_of(folder):
    return {
        str(file.relative_to(folder))
        for file in folder.rglob("*")
        if file.is_file() and "__pycache__" not in file.parts
    }


def test_no_file_of_the_package_is_left_behind(installed):
    assert files_of(installed / "nptcs") == files_of(ROOT / PACKAGE)


def test_a_report_is_rendered_by_the_installed_package(installed, results, tmp_path):
    stored, page = tmp_path / "results.pickle", tmp_path / "report.html"
    stored.write_bytes(pickle.dumps(results))

    run_isolated(installed, RENDER, stored, page)

    assert page.read_text(encoding="utf-8") == render_report(results)


def test_the_command_line_is_installed(installed):
    printed = run_isolated(installed, COMMAND, "--help")
    assert "usage: nptcs" in printed
    assert "new-sheet" in printed


def test_every_module_can_be_imported(installed):
    run_isolated(installed, EVERY_MODULE)
