"""The pages are plain Markdown, and their equations are TeX that can be typeset."""

import re
from pathlib import Path

import pytest
from docutils.utils.math import MathError
from docutils.utils.math.latex2mathml import tex2mathml

ROOT = Path(__file__).parents[3]
PAGES = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *sorted((ROOT / "docs").rglob("*.md"))]
BLOCK = re.compile(r"^ *```math\n(.*?)^ *```$", re.MULTILINE | re.DOTALL)
FENCE = re.compile(r"^ *```.*?^ *```$", re.MULTILINE | re.DOTALL)
CODE = re.compile(r"`[^`]+`")
INLINE = re.compile(r"\$([^$]+)\$")


def equations(text):
    blocks = BLOCK.findall(text)
    return blocks, INLINE.findall(CODE.sub("", FENCE.sub("", text)))


def fault(tex):
    if tex.count("{") != tex.count("}"):
        return "a brace is missing"
    try:
        tex2mathml(tex)
    except (MathError, SyntaxError) as error:
        return str(error)
    return None


@pytest.mark.parametrize("page", PAGES, ids=lambda page: str(page.relative_to(ROOT)))
def test_equations_can_be_typeset(page):
    blocks, inline = equations(page.read_text("utf-8"))
    found = {tex: fault(tex) for tex in [*blocks, *inline]}
    assert {tex: why for tex, why in found.items() if why} == {}
    # GitHub typesets $…$ only if there is no space inside the dollars
    assert [tex for tex in inline if tex != tex.strip()] == []


@pytest.mark.parametrize("page", PAGES, ids=lambda page: str(page.relative_to(ROOT)))
def test_the_page_is_plain_markdown(page):
    text = page.read_text("utf-8")
    assert re.findall(r"^ *(?:```|:::)\{.*", text, re.MULTILINE) == []
    assert re.findall(r"\{\w+\}`", CODE.sub("", FENCE.sub("", text))) == []


def test_the_methods_have_equations():
    pages = [page for page in PAGES if page.parent.name == "methods"]
    without = [page.name for page in pages if not any(equations(page.read_text("utf-8")))]
    assert without == ["decks.md"]


def test_a_wrong_equation_is_noticed():
    assert fault(r"\frac{a}{b}") is None
    assert fault(r"\frac{a}{b") is not None
    assert fault(r"\nosuchcommand{a}") is not None
