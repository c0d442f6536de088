"""The rooms of the package: what imports what, and what each says about itself."""

import ast
from pathlib import Path

import pytest
from importlinter import cli

import nptcs

PACKAGE = Path(nptcs.__file__).parent
ROOT = Path(__file__).resolve().parents[2]
MODULES = sorted(PACKAGE.rglob("*.py"))
ROOMS = sorted(path for path in PACKAGE.rglob("__init__.py") if path.parent != PACKAGE)


def test_no_room_imports_from_above_and_there_is_no_circle():
    """The contracts are in pyproject.toml."""
    assert cli.lint_imports(str(ROOT / "pyproject.toml"), no_cache=True) == cli.EXIT_STATUS_SUCCESS


@pytest.mark.parametrize("module", MODULES, ids=lambda path: str(path.relative_to(PACKAGE)))
def test_no_module_imports_the_private_names_of_another(module):
    private = [
        f"line {node.lineno}: from {node.module} import {name.name}"
        for node in ast.walk(ast.parse(module.read_text("utf-8")))
        if isinstance(node, ast.ImportFrom) and (node.module or "").startswith("nptcs")
        for name in node.names
        if name.name.startswith("_") and not name.name.startswith("__")
    ]
    assert private == []


@pytest.mark.parametrize("room", ROOMS, ids=lambda path: str(path.parent.relative_to(PACKAGE)))
def test_no_room_is_too_large_to_be_read_at_a_glance(room):
    """Of more than twenty modules side by side, some form a separate room."""
    assert len(list(room.parent.glob("*.py"))) <= 20


@pytest.mark.parametrize("room", ROOMS, ids=lambda path: str(path.parent.relative_to(PACKAGE)))
def test_each_room_says_what_comes_in_and_what_does_not_belong_there(room):
    """Two sentences at least after the first line; a newcomer reads them before any code."""
    text = ast.get_docstring(ast.parse(room.read_text("utf-8"))) or ""
    title, _, rest = text.partition("\n\n")
    assert title.strip().endswith(".")
    assert rest.count(". ") + rest.count(".\n") + rest.endswith(".") >= 2, text
