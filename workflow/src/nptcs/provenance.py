"""What code a result rests on, as a hash: Snakemake sees scripts, but not the package.

The hash covers a module and all modules of this package that it imports, directly or not, also
inside functions. It is taken of the syntax tree without docstrings, so that a changed comment,
docstring or line break reruns nothing.
"""

from __future__ import annotations

import ast
import hashlib
from functools import cache
from pathlib import Path

PACKAGE = "nptcs"
_ROOT = Path(__file__).parent


def code_hash(*modules: str) -> str:
    """Hash the code of modules and of all that they import from this package.

    Parameters
    ----------
    *modules : str
        Dotted names of this package's modules, or paths of Python files.

    Returns
    -------
    str
        16 hexadecimal digits.
    """
    digest = hashlib.sha256()
    for file in sorted(_closure(modules)):
        digest.update(_tree(file).encode())
    return digest.hexdigest()[:16]


def imported_modules(*modules: str) -> set[str]:
    """Name the modules of this package that `modules` rest on, themselves included."""
    return {
        ".".join((PACKAGE, *file.relative_to(_ROOT).with_suffix("").parts)).removesuffix(
            ".__init__"
        )
        for file in _closure(modules)
        if file.is_relative_to(_ROOT)
    }


def _closure(modules: tuple[str, ...]) -> set[Path]:
    """Collect the files of modules and of all that they import from this package."""
    found: set[Path] = set()
    waiting = [_file(module) for module in modules]
    if None in waiting:
        missing = modules[waiting.index(None)]
        raise ModuleNotFoundError(f"{missing} is no module of {PACKAGE} and no file")
    while waiting:
        file = waiting.pop()
        if file is None or file in found:
            continue
        found.add(file)
        waiting += [_file(name) for name in _imports(file)]
    return found


def _file(module: str) -> Path | None:
    """Find the file of a module of this package; None for what is none."""
    if module.endswith(".py"):
        return Path(module).resolve() if Path(module).is_file() else None
    parts = module.split(".")
    if parts[0] != PACKAGE:
        return None
    stem = _ROOT.joinpath(*parts[1:])
    package, plain = stem / "__init__.py", stem.with_suffix(".py")
    if package.is_file():
        return package
    return plain if plain.is_file() and stem != _ROOT else None


@cache
def _imports(file: Path) -> tuple[str, ...]:
    """Name all modules that a file may import, wherever the statement stands."""
    names: list[str] = []
    for node in ast.walk(ast.parse(file.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            names += [alias.name for alias in node.names]
        elif isinstance(node, ast.ImportFrom) and node.module and not node.level:
            names.append(node.module)
            names += [f"{node.module}.{alias.name}" for alias in node.names]
    return tuple(names)


@cache
def _tree(file: Path) -> str:
    """Write a file's syntax tree without docstrings and positions."""
    tree = ast.parse(file.read_text(encoding="utf-8"))
    for node in ast.walk(tree):
        body = getattr(node, "body", None)
        if not isinstance(body, list):
            continue
        node.body = [  # type: ignore[attr-defined]
            part
            for part in body
            if not (isinstance(part, ast.Expr) and isinstance(part.value, ast.Constant))
        ]
    return ast.dump(tree)
