"""The kinds of blocks are a closed set: the page template has a macro for each, and no default."""

import re
from importlib import resources
from types import SimpleNamespace
from typing import get_args

import pytest
from jinja2 import PackageLoader, UndefinedError

from nptcs.report.blocks import (
    BlockMacro,
    Facts,
    Finding,
    Findings,
    Folded,
    Interactive,
    Listing,
    MoreTables,
    PageBlock,
    ParagraphKind,
    Plots,
    TableView,
    Text,
    macro_of,
)
from nptcs.report.page_templates import page_environment
from nptcs.tables.result_table import ReportSection

TEMPLATES = resources.files("nptcs.report") / "templates"
ENTRY = SimpleNamespace(file="a.csv", rule="r", source="s")
BLOCKS = [
    TableView(ENTRY, "words of the block", (), (), ()),
    Plots("words of the block", ()),
    Text("words of the block"),
    Listing("words of the block", ()),
    Facts("words of the block", ()),
    Folded("words of the block", ""),
    Interactive("<p>words of the block</p>"),
    MoreTables("words of the block", (Text("in it"),)),
    Findings((Finding("q", "a", "words of the block", "a.csv", ReportSection.CASES),)),
]


def written(block, macro_name=macro_of):
    """Write one block as the page does."""
    environment = page_environment()
    loader = PackageLoader("nptcs.report")
    source = loader.get_source(environment, "report.html.j2")[0]
    macros = source[source.index("{% macro badge") : source.index("{% macro links")]
    environment.globals["macro_of"] = macro_name
    page = environment.from_string(macros + "{{ block(view) }}")
    return page.render(view=block)


def test_each_kind_of_block_is_tried_here_and_has_a_macro_of_its_own():
    assert {type(block) for block in BLOCKS} == set(get_args(PageBlock))
    assert sorted(macro_of(block) for block in BLOCKS) == sorted(get_args(BlockMacro))


@pytest.mark.parametrize("block", BLOCKS, ids=lambda block: type(block).__name__)
def test_the_template_writes_each_kind_of_block(block):
    assert "words of the block" in written(block)


def test_an_unknown_block_is_an_error_and_not_a_paragraph():
    with pytest.raises(AssertionError, match="unreachable"):
        macro_of(SimpleNamespace(text="x", kind=""))
    with pytest.raises(UndefinedError):
        written(Text("x"), lambda block: "picture")


@pytest.mark.parametrize("kind", [kind for kind in get_args(ParagraphKind) if kind])
def test_each_kind_of_paragraph_looks_different(kind):
    if kind == "heading":
        assert "<h3>" in written(Text("x", kind))
        return
    assert re.search(rf"\.{kind}\b", (TEMPLATES / "report.css").read_text("utf-8"))
    assert f'class="{kind}"' in written(Text("x", kind))
