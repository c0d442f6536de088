"""The texts that the package gives to `tr`, found in its code and its page templates."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from pathlib import Path

from jinja2 import Environment, nodes

import nptcs

ROOT = Path(nptcs.__file__).parent
FUNCTIONS = {"tr": 1, "translatable": 1, "tr_count": 2}
"""Functions that are given texts, and how many of their arguments are texts."""


def texts_in_code(source: str) -> Iterator[tuple[str, ...]]:
    """Yield the constant texts that calls of `FUNCTIONS` are given."""
    for node in ast.walk(ast.parse(source)):
        if not isinstance(node, ast.Call) or not isinstance(node.func, ast.Name):
            continue
        given = node.args[: FUNCTIONS.get(node.func.id, 0)]
        texts = [part.value for part in given if isinstance(part, ast.Constant)]
        if texts and len(texts) == len(given):
            yield tuple(str(text) for text in texts)


def texts_in_template(source: str) -> Iterator[tuple[str, ...]]:
    """Yield the constant texts that calls of `tr` in a page template are given."""
    for node in Environment().parse(source).find_all(nodes.Call):
        if isinstance(node.node, nodes.Name) and node.node.name in FUNCTIONS:
            given = node.args[: FUNCTIONS[node.node.name]]
            if all(isinstance(part, nodes.Const) for part in given):
                yield tuple(part.value for part in given)  # type: ignore[attr-defined]


def texts_of_package() -> dict[tuple[str, ...], str]:
    """Return every text of code and templates, and the first file that has it."""
    found: dict[tuple[str, ...], str] = {}
    for pattern, read in (("*.py", texts_in_code), ("*.j2", texts_in_template)):
        for file in sorted(ROOT.rglob(pattern)):
            for texts in read(file.read_text(encoding="utf-8")):
                found.setdefault(texts, str(file.relative_to(ROOT)))
    return found


def as_entry(texts: tuple[str, ...], where: str) -> str:
    """Write a text as an entry of a catalogue that waits for its translation."""
    quoted = ['"' + text.replace("\\", "\\\\").replace('"', '\\"') + '"' for text in texts]
    if len(texts) == 1:
        return f'#: {where}\nmsgid {quoted[0]}\nmsgstr ""\n'
    return f'#: {where}\nmsgid {quoted[0]}\nmsgid_plural {quoted[1]}\nmsgstr[0] ""\n'
