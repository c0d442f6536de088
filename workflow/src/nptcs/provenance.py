"""The code that a result depends on, as a hash: Snakemake sees scripts, but not the package.

The hash covers a script or module and all modules of this package that it imports, directly or
not, also inside functions. It is taken of the compiled code without docstrings and line numbers,
so that a changed comment, docstring or line break reruns nothing.
"""

from __future__ import annotations

import ast
import hashlib
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from types import CodeType

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
        digest.update(_read(file)[1])
    return digest.hexdigest()[:16]


def imported_modules(*modules: str) -> set[str]:
    """Name the modules of this package that `modules` depend on, themselves included."""
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
        raise ModuleNotFoundError(f"{missing} is neither a module of {PACKAGE} nor a file")
    while waiting:
        file = waiting.pop()
        if file is None or file in found:
            continue
        found.add(file)
        waiting += [_file(name) for name in _read(file)[0]]
    return found


def _file(module: str) -> Path | None:
    """Find the file of a module of this package; None if there is none."""
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
def _read(file: Path) -> tuple[tuple[str, ...], bytes]:
    """Return the modules that a file may import, and a digest of its compiled code."""
    tree = ast.parse(file.read_text(encoding="utf-8"))
    code = compile(tree, "", "exec", dont_inherit=True, optimize=2)
    return tuple(_imports(tree)), hashlib.sha256(repr(_parts(code)).encode()).digest()


def _imports(tree: ast.Module) -> Iterator[str]:
    """Yield all names that may be imported modules, wherever the statement is."""
    statements: list[ast.AST] = [tree]
    while statements:
        node = statements.pop()
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom) and node.module and not node.level:
            yield node.module
            yield from (f"{node.module}.{alias.name}" for alias in node.names)
        for blocks in ("body", "orelse", "finalbody", "handlers", "cases"):
            block = getattr(node, blocks, [])
            statements += block if isinstance(block, list) else []


def _parts(constant: object) -> object:
    """Take from compiled code all that decides what it does, in a form that prints the same."""
    if isinstance(constant, CodeType):
        names = constant.co_names, constant.co_varnames, constant.co_freevars, constant.co_cellvars
        counts = constant.co_argcount, constant.co_posonlyargcount, constant.co_kwonlyargcount
        constants = [_parts(part) for part in constant.co_consts]
        return constant.co_name, constant.co_flags, counts, names, constant.co_code, constants
    if isinstance(constant, frozenset):
        return sorted(repr(part) for part in constant)
    if isinstance(constant, tuple):
        return [_parts(part) for part in constant]
    return constant
