"""The comparison of two runs as a page and a workbook, and what a reader finds on them."""

import io
import re
from dataclasses import replace

import openpyxl
import pandas as pd
import pytest
from axe_check import CHROMIUM, NO_CHROMIUM, chromium, opened, violations

from nptcs.language import language
from nptcs.report.comparison.page import comparison_page, differing
from nptcs.report.comparison.workbook import comparison_workbook
from nptcs.runs.compare import compare_runs
from nptcs.runs.finished import read_run
from nptcs.runs.part import RESULT, Part
from nptcs.tables.result_table import Heading


@pytest.fixture(scope="module")
def rubber(march, april):
    return compare_runs(read_run(march, "A"), read_run(april, "B"))


def test_page_and_workbook_show_the_same_rows(rubber):
    page = comparison_page(rubber)
    assert page.count("<section") == 1 + len(rubber.parts)
    assert "SYNTHETIC DATA" in page
    assert "tested_002" in page
    assert "tested_001" not in page
    workbook = openpyxl.load_workbook(io.BytesIO(comparison_workbook(rubber)))
    assert workbook.sheetnames == ["Summary", *(part.name for part in rubber.parts)]
    for part in rubber.parts:
        sheet = workbook[part.name]
        assert sheet.max_row == 1 + len(part.table)
        names = [cell.value.split(" [")[0] for cell in sheet[1]]
        results = [row[names.index("result")].value for row in sheet.iter_rows(min_row=2)]
        assert results == [str(one) for one in part.table[RESULT]]


def test_the_page_has_the_names_that_people_use_and_those_of_the_files_on_hover(rubber):
    page = comparison_page(rubber)
    assert '<abbr title="spoke_c10_mpa">spoke C10 (S-C)</abbr>' in page
    assert '<abbr title="vertical_stiffness_n_per_mm">vertical stiffness</abbr>' in page
    assert '<abbr title="c10_mpa">C10</abbr>' in page
    before_the_keys = page[page.index("<body>") : page.index('<section id="configuration">')]
    shown = re.sub(r"<[^>]*>", "", before_the_keys)
    assert "C10 of rubber_88A by +5.80" in shown
    assert "spoke C10 (S-C)\xa02.93\xa0MPa" in shown
    assert "c10_mpa" not in shown


def test_a_decision_is_read_in_words_of_the_pages_language():
    rows = [
        ("goals", "plate_mass ≤ 2; minimise plate_mass", "plate_mass ≤ 3"),
        ("with_probability", "0.9", "0.8"),
        ("design", "22 plates, spacing_mm 14.333", "15 plates, spacing_mm 20"),
        ("status", "feasible", "no design"),
        ("study", "plate_mass", "tyre_mass"),  # a name that the user gave
    ]
    table = pd.DataFrame(rows, columns=["what", "a", "b"]).assign(decision="k", result="different")
    part = Part("decisions", "Decisions", "", table)
    labels = {"spacing_mm": Heading("plate spacing S", "mm")}
    english = differing(part, False, labels)
    assert [[cell.text for cell in cells[:2]] for _, cells in english.rows] == [
        ["goals", "plate mass ≤ 2; minimise plate mass"],
        ["required probability", "0.9"],
        ["design", "22 plates, plate spacing S\xa014.33\xa0mm"],
        ["status", "feasible"],
        ["study", "plate_mass"],
    ]
    with language("zh"):
        chinese = differing(part, False, labels)
    texts = [[cell.text for cell in cells[:2]] for _, cells in chinese.rows]
    assert texts[2] == ["设计", "22 块板, 板间距 S\xa014.33\xa0mm"]
    assert texts[3] == ["状态", "可行"]
    assert chinese.rows[2][1][1].name_in_file == "22 块板, spacing_mm 14.333"


def test_a_long_text_of_all_differing_rows_is_not_lost(rubber):
    part = rubber.part("stiffness")
    design = ", ".join(f"factor_{number}_mm {number}" for number in range(1, 7))
    view = differing(replace(part, table=part.table.assign(design_a=design)), True, {})
    assert len(view.notes) == 1
    assert view.notes[0].endswith("factor 5\xa05\xa0mm, factor 6\xa06\xa0mm")
    assert (view.synthetic, view.all_rows) == (True, 3)


@pytest.mark.skipif(CHROMIUM is None, reason=NO_CHROMIUM)
@pytest.mark.parametrize("width", [1280, 390])
def test_axe_finds_no_barrier(rubber, tmp_path, width):
    file = tmp_path / "comparison.html"
    file.write_text(comparison_page(rubber), encoding="utf-8")
    with chromium() as browser, opened(browser, file, "light", width) as (page, said):
        assert violations(page) == []
        assert page.evaluate("document.documentElement.scrollWidth") <= width
        assert said == []
