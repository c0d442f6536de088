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
    Plot,
    Plots,
    TableView,
    Text,
    macro_of,
)
from nptcs.report.page_templates import page_environment
from nptcs.report.sections.plan import folded_blocks
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
    MoreTables("words of the block", "what they say", (Text("in it"),)),
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


def test_each_kind_of_block_is_tried_here_and_has_its_own_macro():
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


def test_a_folded_table_opens_on_demand_and_says_how_long_it_is():
    view = TableView(ENTRY, "a long table", (), (), (("", ()),) * 9, all_rows=61, folded=True)
    page = written(view)
    assert re.search(
        r"<details[^>]*>\s*<summary>a long table.*61 rows.*<table>.*</details>", page, re.S
    )
    assert "<details" not in written(TableView(ENTRY, "a short table", (), (), ()))


@pytest.mark.parametrize(("shown", "open_", "folded"), [(None, 3, 0), (2, 2, 1), (0, 0, 3)])
def test_further_figures_open_on_demand(shown, open_, folded):
    plots = tuple(Plot(lambda: ("<svg/>", ""), f"words {n}", f"figure{n}") for n in range(3))
    before, _, after = written(Plots("a caption", plots, shown)).partition("<details")
    assert (before.count("<svg/>"), after.count("<svg/>")) == (open_, folded)
    assert "a caption" in before
    assert all(f"words {n}" in after for n in range(open_, 3))


def test_a_section_folds_long_tables_only_next_to_something_else():
    long_ = TableView(ENTRY, "long", (), (), (("", ()),) * 7)
    short = TableView(ENTRY, "short", (), (), (("", ()),) * 6)
    assert [view.folded for view in folded_blocks([Text("x"), long_, short])[1:]] == [True, False]
    assert [view.folded for view in folded_blocks([long_, short])] == [False, False]
