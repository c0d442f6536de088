"""The examples in docstrings and the Python blocks of the docs run, and print what they say."""

import ast
import doctest
import importlib
import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[3]
SOURCE = ROOT / "workflow" / "src"
FLAGS = doctest.ELLIPSIS | doctest.NORMALIZE_WHITESPACE
WITH_EXAMPLES = [file for file in sorted(SOURCE.rglob("*.py")) if ">>> " in file.read_text("utf-8")]
PYTHON_BLOCK = re.compile(r"^```python\n(.*?)^```$", re.MULTILINE | re.DOTALL)
PAGES = [
    page
    for page in [ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md"))]
    if PYTHON_BLOCK.search(page.read_text("utf-8"))
]


def dotted(file):
    return ".".join(file.relative_to(SOURCE).with_suffix("").parts).removesuffix(".__init__")


@pytest.mark.parametrize("file", WITH_EXAMPLES, ids=dotted)
def test_examples_print_what_they_say(file):
    module = importlib.import_module(dotted(file))
    printed = []
    runner = doctest.DocTestRunner(optionflags=FLAGS)
    for case in doctest.DocTestFinder().find(module):
        runner.run(case, out=printed.append)
    assert runner.tries > 0
    assert runner.failures == 0, "".join(printed)


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_python_blocks_of_the_docs_run(page):
    for block in PYTHON_BLOCK.findall(page.read_text("utf-8")):
        exec(compile(block, str(page), "exec"), {})  # noqa: S102


def has_example(node):
    text = ast.get_docstring(node) if isinstance(node, ast.FunctionDef | ast.ClassDef) else None
    return text is not None and ">>> " in text


def test_what_newcomers_call_first_has_an_example():
    named = {
        f"{dotted(file)}.{node.name}"
        for file in WITH_EXAMPLES
        for node in ast.walk(ast.parse(file.read_text("utf-8")))
        if has_example(node)
    }
    assert named >= {
        "nptcs.calibrate.fit.fit_model",
        "nptcs.design.full_factorial",
        "nptcs.laminate.abd",
        "nptcs.lca.single.solve",
        "nptcs.reduce.curve.chord.chord_slope",
        "nptcs.surface.fit.fit",
        "nptcs.surface.sensitivity.gradients.impact",
        "nptcs.terms.Polynomial",
        "nptcs.tables.io.write_table",
    }
