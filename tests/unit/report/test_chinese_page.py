"""The report in Chinese: none of its own words stays English, and no number changes."""

import io
import re
from dataclasses import replace
from gettext import NullTranslations

import openpyxl
import pytest
from matplotlib.figure import Figure

from nptcs.config.root import read_config
from nptcs.language import language, tr
from nptcs.language.translate import _translations
from nptcs.report.figures.style import panel, styled, to_svg
from nptcs.report.html import render_report
from nptcs.report.text import text_width, wrapped
from nptcs.report.workbook.build import build_workbook
from nptcs.tables.catalogue import TABLES

KEPT = re.compile(
    r"[\W\d_]*|.*[\u4e00-\u9fff].*|A title.*|[^ ]*/[^ ]*\.\w+|[^ ]*\.csv.*|[a-z]+(_[a-z]+)+"
    r"|[A-Z]{1,5}\d*|[A-Z]\d\d?|ν\d\d|SHA-256|R²|[xy] \[mm\]|\S+ \[\S+\]|[nsxy]|k B|cfrp.*|rubber.*"
    r"|published|(mm|MPa|N/mm|N)|chord|least squares|no row names it|a README is a note"
    r"|not transversely isotropic|slipped in the grip",
    re.DOTALL,
)
"""Texts that are the same in both languages: symbols, units, files, names, a user's own titles,
and texts in the tables of these tests that no stage writes."""

RULES = frozenset(name for row in TABLES.values() for name in (row.rule, *row.rule.split(", "))) | {
    "calibrate_ply, material_card",
    "calibrate_rubber, material_card",
    "ingest",
}
"""Names of rules."""


class Recorder(NullTranslations):
    """Notes the texts that the catalogue does not contain."""

    def __init__(self):
        super().__init__()
        self.missed = set()

    def gettext(self, message):
        self.missed.add(message)
        return message


@pytest.fixture
def recorder(monkeypatch):
    found = Recorder()
    monkeypatch.setattr(_translations("zh"), "_fallback", found)
    return found


@pytest.fixture(scope="module")
def chinese(results):
    values = results.config.model_dump(mode="json")
    values["laboratory"]["language"] = "zh"
    return replace(results, config=read_config(values))


def test_every_text_of_the_page_has_a_translation(chinese, results, recorder):
    page = render_report(chinese)
    assert '<html lang="zh">' in page
    left = {text for text in recorder.missed if not KEPT.fullmatch(text)} - RULES
    assert left == set(), "\n".join(sorted(left))
    english = render_report(results)
    cells = re.compile(r'data-n="([^"]*)"')
    assert cells.findall(page) == cells.findall(english)


def test_the_cells_of_the_workbook_are_chinese_but_for_names(chinese):
    workbook = openpyxl.load_workbook(io.BytesIO(build_workbook(chinese)))
    english = re.compile(r"(?:[a-z][a-z'-]+[,;:]? +){3}[a-z]")
    texts = {
        text
        for sheet in workbook
        for cell in (cell for row in sheet.iter_rows() for cell in row)
        for text in (cell.value, cell.comment and cell.comment.text)
        if isinstance(text, str) and english.search(text.split("\n")[0])
        if "sheet, ingest, reduce" not in text  # names of stages
    }
    assert {text for text in texts if not KEPT.fullmatch(text)} == set()


def test_a_recorder_sees_a_text_without_a_translation(recorder):
    with language("zh"):
        tr("Nobody has translated this")
    assert [text for text in recorder.missed if not KEPT.fullmatch(text)] != []


@styled
def drawn(title: str) -> Figure:
    figure, _ = panel(title, "载荷 [N]", "位移 [mm]")
    return figure


def test_chinese_text_is_drawn_without_a_chinese_font_and_has_room():
    svg = to_svg(drawn("各因子对竖向刚度的影响，求解器"))
    assert "各因子对竖向刚度的影响" in svg


@pytest.mark.parametrize(
    "text", ["各因子对竖向刚度的影响，求解器 fe_tyre", "Impact of each factor"]
)
@pytest.mark.parametrize("width", [8, 12, 20])
def test_lines_are_no_wider_than_asked_and_nothing_is_lost(text, width):
    lines = wrapped(text, width).split("\n")
    assert "".join("".join(lines).split()) == "".join(text.split())
    longest_word = max(text_width(word) for word in re.findall(r"[a-zA-Z_]+", text))
    assert all(text_width(line) <= max(width + 1.75, longest_word + 1.75) for line in lines)
    assert not any(line.startswith("，") for line in lines)
