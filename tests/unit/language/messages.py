"""The texts that the package gives to `tr`, found in its code and its page templates."""

from __future__ import annotations

import ast
import csv
import re
from collections.abc import Iterator
from pathlib import Path
from typing import get_args

import yaml
from jinja2 import Environment, nodes

import nptcs
from nptcs.config.studies.response import RESPONSE_KINDS
from nptcs.config.studies.sensitivity import AveragingRule
from nptcs.mechanical_tests import TestType
from nptcs.report.comparison.parts import side_heading
from nptcs.report.figures.lca import REGIONS
from nptcs.report.figures.uncertainty import KINDS
from nptcs.report.tables import entries
from nptcs.report.tables.headings import UNITS, heading, words
from nptcs.runs import all_tables, constants, decisions, ranking, stiffness
from nptcs.runs.part import Found
from nptcs.solvers.registry import MODULES, load_solver
from nptcs.tables.catalogue import TABLES
from nptcs.tables.laboratory.files import FileStatus
from nptcs.tables.laboratory.flags import FLAG_KINDS
from nptcs.tables.result_table import Heading
from nptcs.tables.status import Status
from nptcs.tables.tyres.spoke_stiffness import DIRECTIONS

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


COMPARED = {
    all_tables.COLUMNS: all_tables.HEADINGS,
    constants.COLUMNS: constants.HEADINGS,
    decisions.COLUMNS: {},
    ranking.COLUMNS: ranking.HEADINGS,
    stiffness.COLUMNS: stiffness.HEADINGS,
    stiffness.SUMMARY_COLUMNS: {},
    ("key", "software", "file", "result"): {},
}
"""Columns of the parts of a comparison, and their headings."""


def closed_texts() -> Iterator[str]:
    """Yield the texts that the report gives to `tr` from lists elsewhere in the package."""
    for table in TABLES.values():
        yield from (table.title, table.source)
        for column, field in table.contract.to_schema().columns.items():
            written = heading(column, table.headings)
            yield from (written.name, written.unit)
            if field.description:
                yield field.description
    for entry in (value for value in vars(entries).values() if isinstance(value, entries.Entry)):
        yield from (entry.title, entry.source, entry.file)
        yield from (part for head in entry.headings.values() for part in (head.name, head.unit))
    yield from (load_solver(module).about for module in MODULES.values())
    yield from map(words, RESPONSE_KINDS)
    yield from map(words, get_args(AveragingRule))
    yield from (test.value.removeprefix("rubber_").replace("_", " ") for test in TestType)
    yield from (status.value for status in (*Status, *FileStatus))
    yield from (*FLAG_KINDS, *KINDS, *REGIONS, *DIRECTIONS)
    yield from (found.value for found in Found)
    for columns, headings in COMPARED.items():
        for column in columns:
            one = heading(column, headings)
            if column not in headings and (side := side_heading(column)) is not None:
                one = Heading(side.name[:-2], side.unit)
            yield from (one.name, one.unit)
    yield from texts_of_configurations()
    yield from texts_of_the_example()


def texts_of_the_example() -> Iterator[str]:
    """Yield the reasons and remarks of the specimens in the example's sheet."""
    with (ROOT.parents[2] / "raw_data/example/specimens.csv").open(encoding="utf-8") as sheet:
        for row in csv.DictReader(sheet):
            yield from filter(None, (row["reason"], row["remarks"]))


def texts_of_configurations() -> Iterator[str]:
    """Yield titles and labels of the configurations that are shipped."""
    for file in sorted((ROOT.parents[2] / "config").glob("*.yaml")):
        waiting = [yaml.safe_load(file.read_text(encoding="utf-8"))]
        while waiting:
            node = waiting.pop()
            if isinstance(node, dict):
                yield from (node[key] for key in ("title", "label") if key in node)
                waiting += node.values()
            elif isinstance(node, list):
                waiting += node


SAME = re.compile(r"B − A|[\W\d_]*|[A-Z]{1,2}\d*|[xyn]|k B|MNR|PRESS|SHA-256|(results|config)/.*")
"""Symbols, abbreviations and file names, which are the same in every language."""


def texts_of_package() -> dict[tuple[str, ...], str]:
    """Return every text of code and templates, and the first file that has it."""
    found: dict[tuple[str, ...], str] = {}
    for pattern, read in (("*.py", texts_in_code), ("*.j2", texts_in_template)):
        for file in sorted(ROOT.rglob(pattern)):
            for texts in read(file.read_text(encoding="utf-8")):
                found.setdefault(texts, str(file.relative_to(ROOT)))
    for text in closed_texts():
        if not SAME.fullmatch(text) and text not in UNITS.values():
            found.setdefault((text,), "closed lists")
    return found


def as_entry(texts: tuple[str, ...], where: str) -> str:
    """Write a text as an entry of a catalogue that waits for its translation."""
    quoted = ['"' + text.replace("\\", "\\\\").replace('"', '\\"') + '"' for text in texts]
    if len(texts) == 1:
        return f'#: {where}\nmsgid {quoted[0]}\nmsgstr ""\n'
    return f'#: {where}\nmsgid {quoted[0]}\nmsgid_plural {quoted[1]}\nmsgstr[0] ""\n'
