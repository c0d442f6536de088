"""A row of the catalogue is all that the report and the workbook need of a new result table."""

import io
from datetime import UTC, datetime

import openpyxl
import pandas as pd
import pandera.pandas as pa
import pytest
from pandera.typing.pandas import Series

from nptcs.files import write_model
from nptcs.report.data import read_results
from nptcs.report.html import render_report
from nptcs.report.sections import plan
from nptcs.report.tables.sheets import sheets_of
from nptcs.report.workbook.build import build_workbook
from nptcs.runs.identity import identify
from nptcs.surface.stored import dump
from nptcs.tables.catalogue import TABLES, result_files
from nptcs.tables.io import write_table
from nptcs.tables.result_table import (
    Heading,
    ReportSection,
    ResultTable,
    RowMark,
    SyntheticBy,
)

TITLE = "Sound of the tyre, study by study"


class Sound(pa.DataFrameModel):
    """Made up for this test."""

    study: Series[str]
    solver: Series[str]
    status: Series[str]
    loudness: Series[float] = pa.Field(description="At 1 m")


@pytest.fixture(autouse=True)
def undrawn(monkeypatch):
    monkeypatch.setattr("nptcs.report.drawing.to_svg", lambda figure: "<svg/>")


def catalogued(monkeypatch, **changes):
    row = {
        "section": ReportSection.SENSITIVITY,
        "headings": {"loudness": Heading("loudness", "dB")},
        "mark": RowMark.STATUS,
        "synthetic": SyntheticBy.ROWS,
        **changes,
    }
    table = ResultTable(Sound, TITLE, "sound", "the records of the cases", **row)
    monkeypatch.setitem(TABLES, "sound.csv", table)


@pytest.fixture
def written(results, tmp_path):
    """The files of a run, with those of the made-up table."""
    sound = pd.DataFrame(
        {
            "study": ["plate", "rubber"],
            "solver": "published",
            "status": ["ok", "diverged"],
            "loudness": [61.234567, 70.0],
        }
    )
    tables = {**results.tables, "sound.csv": sound}
    for name, row, _ in result_files(results.surface_studies):
        write_table(tmp_path / "tables" / name, tables[name], row.contract)
    write_table(tmp_path / "tables" / "sound.csv", sound, Sound)
    (tmp_path / "surfaces").mkdir()
    (tmp_path / "designs").mkdir()
    for study, surfaces in results.surfaces.items():
        (tmp_path / "surfaces" / f"{study}.json").write_text(dump(surfaces))
        results.designs[study].to_csv(tmp_path / "designs" / f"{study}.csv", index=False)
    write_model(tmp_path / "card.json", results.card)
    files = {name: list((tmp_path / name).iterdir()) for name in ("tables", "surfaces", "designs")}
    for record in results.records.values():
        file = tmp_path / f"{record.specimen}.json"
        write_model(file, record)
        files.setdefault("records", []).append(file)
    for name, curve in results.curves.items():
        curve.to_csv(tmp_path / f"{name}.csv", index=False)
        files.setdefault("curves", []).append(tmp_path / f"{name}.csv")
    identity = identify({}, {}, "c0de", {}, {}, datetime(2026, 11, 26, tzinfo=UTC))
    write_model(tmp_path / "identity.json", identity)
    known = {"card": tmp_path / "card.json", "identity": tmp_path / "identity.json"}
    return {**files, **known, "models": [], "inputs": []}


@pytest.fixture
def read(results, written):
    facts = {"about": "looked up", "needs_ply": False, "loads_tyre": True}
    job = {
        "config": results.config.model_dump(mode="json"),
        "specimens": [specimen.model_dump(mode="json") for specimen in results.sheet],
        "solvers": {"published": facts},
    }
    return lambda: read_results(job, written)


@pytest.mark.parametrize(
    ("section", "anchor", "following"),
    [
        (ReportSection.SENSITIVITY, "sensitivity", "spoke"),
        (ReportSection.FURTHER, "further", "provenance"),
    ],
)
def test_its_row_brings_it_into_workbook_and_page(read, monkeypatch, section, anchor, following):
    catalogued(monkeypatch, section=section)
    run = read()
    workbook = openpyxl.load_workbook(io.BytesIO(build_workbook(run)))
    sheet = [list(row) for row in workbook["sound"].iter_rows(values_only=True)]
    assert sheet[0] == ["study", "solver", "status", "loudness [dB]"]
    assert sheet[1:] == [["plate", "published", "ok", 61.234567]] + [
        ["rubber", "published", "diverged", 70.0]
    ]
    meanings = {row[3]: row[4] for row in workbook["columns"].iter_rows(values_only=True)}
    assert meanings["loudness"] == "At 1 m"

    page = render_report(run)
    start = page.index(f'<section id="{anchor}">')
    inside = page[start : page.index(f'<section id="{following}">')]
    assert inside.count(f"<strong>{TITLE}</strong>") == 1
    assert "61.235" in inside
    assert '<tr class="bad"><td>rubber</td>' in inside
    assert "rule sound" in inside


def test_without_its_row_the_file_is_not_shown_and_no_section_is_empty(read):
    page = render_report(read())
    assert TITLE not in page
    assert 'id="further"' not in page


def test_a_long_table_is_named_and_not_printed(read, monkeypatch):
    catalogued(monkeypatch)
    monkeypatch.setattr(plan, "MOST_ROWS", 1)
    page = render_report(read())
    assert f"{TITLE}: 2 rows, in results/tables/sound.csv" in page
    assert "61.235" not in page


def test_its_row_says_what_makes_it_synthetic(read, monkeypatch):
    expected = {
        SyntheticBy.NOTHING: False,
        SyntheticBy.SPECIMENS: True,
        SyntheticBy.PLIES: True,
        SyntheticBy.RUBBERS: True,
        SyntheticBy.STUDIES: False,  # of published results
        SyntheticBy.ROWS: False,
    }
    assert set(expected) == set(SyntheticBy)
    catalogued(monkeypatch)
    run = read()
    for by, synthetic in expected.items():
        catalogued(monkeypatch, synthetic=by)
        assert sheets_of(run)["sound"].synthetic is synthetic, by


def test_every_section_has_a_plan_in_reading_order():
    assert list(plan.PLANS) == [name for name in ReportSection if name != ReportSection.SUMMARY]
