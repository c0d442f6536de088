"""The code that a result depends on, as a hash: Snakemake sees scripts, but not the package.

The hash covers a script or module and all modules of this package that it imports, directly or
not, also inside functions. It is taken from the compiled code without docstrings and line numbers,
so that a changed comment, docstring or line break reruns nothing. Words that only a reader sees
(messages of errors, descriptions of settings, the version of the package) do not count either,
except for pages that print them.
"""

from __future__ import annotations

import ast
import hashlib
from collections.abc import Iterator, Mapping
from functools import cache
from pathlib import Path
from types import CodeType
from typing import TypeVar

PACKAGE = "nptcs"
_ROOT = Path(__file__).parent

_Documented = TypeVar("_Documented", ast.FunctionDef, ast.ClassDef)

WORDS_OF_CALL: Mapping[str, frozenset[str]] = {
    "Field": frozenset({"description", "title", "examples"}),
    "Solver": frozenset({"about"}),
    "SolverResult": frozenset({"message"}),
}
"""Keyword arguments that contain words for a reader, by the name of what is called."""


def code_hash(*modules: str, words: bool = False) -> str:
    """Hash the code of modules and of everything that they import from this package.

    Parameters
    ----------
    *modules : str
        Dotted names of this package's modules, or paths of Python files.
    words : bool
        Whether messages and descriptions count: for code whose output shows them.

    Returns
    -------
    str
        16 hexadecimal digits.
    """
    digest = hashlib.sha256()
    for file in sorted(_closure(modules)):
        of_file = _digest_with_words(file) if words else _examined(file)[1]
        digest.update(of_file.encode())
    return digest.hexdigest()[:16]


def imported_modules(*modules: str) -> set[str]:
    """Return the modules of this package that `modules` depend on, including themselves."""
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
        waiting += [_file(name) for name in _examined(file)[0]]
    return found


def _file(module: str) -> Path | None:
    """Find the file of a module of this package; None if there is none."""
    if module.endswith(".py"):
        return Path(module).resolve() if Path(module).is_file() else None
    return _file_in(_ROOT, module)


@cache
def _file_in(root: Path, module: str) -> Path | None:
    parts = module.split(".")
    if parts[0] != PACKAGE:
        return None
    stem = root.joinpath(*parts[1:])
    package, plain = stem / "__init__.py", stem.with_suffix(".py")
    if package.is_file():
        return package
    return plain if plain.is_file() and stem != root else None


@cache
def _examined(file: Path) -> tuple[tuple[str, ...], str]:
    """Return the modules that a file may import, and the digest of its code without words."""
    tree = ast.parse(file.read_text(encoding="utf-8"))
    imports = tuple(_imports(tree))  # the digest changes the tree
    return imports, _digest_without_words(tree)


@cache
def _digest_with_words(file: Path) -> str:
    return code_digest(file.read_text(encoding="utf-8"), words=True)


def code_digest(source: str, words: bool = False) -> str:
    """Digest the code of one module by what it does.

    Parameters
    ----------
    source : str
        Python code.
    words : bool
        Whether messages and descriptions count.

    Returns
    -------
    str
        64 hexadecimal digits.

    Examples
    --------
    >>> code_digest("x = 1  # a") == code_digest("x = 1")
    True
    >>> code_digest("x = 1") == code_digest("x = 2")
    False
    >>> code_digest("raise ValueError('no')") == code_digest("raise ValueError('not so')")
    True
    """
    if not words:
        return _digest_without_words(ast.parse(source))
    return _digest(compile(source, "", "exec", dont_inherit=True, optimize=0))


def _digest_without_words(tree: ast.Module) -> str:
    told = _WithoutWords().visit(tree)
    return _digest(compile(told, "", "exec", dont_inherit=True, optimize=2))


def _digest(code: CodeType) -> str:
    return hashlib.sha256(repr(_parts(code)).encode()).hexdigest()


class _WithoutWords(ast.NodeTransformer):
    """Remove the words that only a reader sees."""

    def visit_FunctionDef(self, node: ast.FunctionDef) -> ast.AST:
        return self.generic_visit(_without_docstring(node))

    def visit_Raise(self, node: ast.Raise) -> ast.AST:
        if isinstance(node.exc, ast.Call):
            node.exc = _Silent().visit(node.exc)
        return self.generic_visit(node)

    def visit_Call(self, node: ast.Call) -> ast.AST:
        name = _last_name(node.func)
        if name.endswith(("Error", "Warning")) or name in ("print", "warn"):
            return _Silent().visit(node)
        words = WORDS_OF_CALL.get(name, frozenset())
        node.keywords = [keyword for keyword in node.keywords if keyword.arg not in words]
        return self.generic_visit(node)

    def visit_ClassDef(self, node: ast.ClassDef) -> ast.AST:
        if any(_last_name(base).endswith(("Error", "Exception")) for base in node.bases):
            node.body = [
                part
                for part in node.body
                if not (isinstance(part, ast.FunctionDef) and part.name == "__str__")
            ] or [ast.copy_location(ast.Pass(), node)]
        return self.generic_visit(_without_docstring(node))

    def visit_Assign(self, node: ast.Assign) -> ast.AST | None:
        if [_last_name(target) for target in node.targets] == ["__version__"]:
            return None
        return self.generic_visit(node)


def _without_docstring(node: _Documented) -> _Documented:
    if ast.get_docstring(node, clean=False) is not None:
        node.body = node.body[1:] or [ast.copy_location(ast.Pass(), node)]
    return node


class _Silent(ast.NodeTransformer):
    """Replace every text with an empty one."""

    def visit_Constant(self, node: ast.Constant) -> ast.AST:
        return _empty_text(node) if isinstance(node.value, str) else node

    def visit_JoinedStr(self, node: ast.JoinedStr) -> ast.AST:
        return _empty_text(node)


def _empty_text(place: ast.expr) -> ast.Constant:
    return ast.copy_location(ast.Constant(""), place)


def _last_name(node: ast.AST) -> str:
    """Name of what is called or inherited from, without the modules before it."""
    if isinstance(node, ast.Attribute):
        return node.attr
    return node.id if isinstance(node, ast.Name) else ""


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
    """Reduce compiled code to what decides what it does, in a form that always prints the same."""
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
