"""Section on the solved tyres, from records written by hand."""

from dataclasses import replace

import numpy as np
import pandas as pd
import pytest

from nptcs.campaign.record import CaseRecord
from nptcs.config.studies.responses import TyreResponseSettings
from nptcs.report.blocks import Listing, MoreTables, Plots, TableView, Text
from nptcs.report.figures.tyre import load_displacement, plate_faces
from nptcs.report.sections.plan import build_sections
from nptcs.report.sections.tyre import tyre_section
from nptcs.report.tables.sheets import sheets_of
from nptcs.responses.strength import PlyStrengths
from nptcs.responses.table import plate_stress, tyre_curves, tyre_responses
from nptcs.solvers.contract import SolverResult, Status
from nptcs.tables.io import check
from nptcs.tables.result_table import ReportSection
from nptcs.tables.tyres.cases import Cases
from nptcs.tables.tyres.tyre_responses import PlateStress, TyreCurves, TyreResponses

LOADS = np.linspace(0.0, 5000.0, 11)
PLATES = {
    "spoke": [0.0] * 4,
    "leg": [0.0, 1.0, 0.0, 1.0],
    "face": [0.0, 0.0, 1.0, 1.0],
    "height_mm": [28.0, 56.0, 28.0, 56.0],
    "ply_deg": [45.0, 45.0, -45.0, -45.0],
    "along_mpa": [80.0, 70.0, -80.0, -60.0],
    "across_mpa": [10.0, 9.0, -10.0, -8.0],
    "shear_mpa": [5.0, 4.0, -5.0, -4.0],
    "mises_mpa": [88.0, 80.0, 86.0, 70.0],
    "mean_mises_mpa": [87.0, 79.0, 85.0, 69.0],
}
EXTRA = {"contact_length_mm": 36.0, "plate_largest_mises_mpa": 88.0, "plate_volume_mm3": 6e5}
STRENGTHS = PlyStrengths(2000.0, 1200.0, 50.0, 180.0, 80.0)


def record(case_id, stiffness=265.0, message="", status=Status.OK, **change):
    parts = {
        "extra": EXTRA,
        "curve": {"displacement_mm": (LOADS / stiffness).tolist(), "force_n": LOADS.tolist()},
        "plate_stress": PLATES,
    }
    if status == Status.OK:
        parts |= {"vertical_stiffness_n_per_mm": stiffness, "displacement_mm": 5000.0 / stiffness}
    return CaseRecord(
        study="plate",
        case_id=case_id,
        solver="fe_tyre_paper",
        solver_version="1",
        key="k",
        values={},
        load_n=5000.0,
        wall_time_s=1.0,
        result=SolverResult(status=status, message=message, **(parts | change)),
    )


def responses(*records, settings=None, strengths=STRENGTHS):
    table = tyre_responses(records, settings or TyreResponseSettings(), strengths)
    return check(table, TyreResponses, "").set_index(["case_id", "response", "at"])


def test_a_straight_curve_has_one_stiffness_and_ends_where_it_ends():
    table = responses(record("plate_001"))
    for load in ("1500 N", "3000 N", "5000 N"):
        for name in ("secant_stiffness", "tangent_stiffness"):
            assert table.loc["plate_001", name, load].value == pytest.approx(265.0)
    at_25 = table.loc["plate_001", "secant_stiffness", "25 mm"]
    assert at_25.status == "not reached"
    assert np.isnan(at_25.value)
    assert "18.87 mm" in at_25.note
    soft = responses(record("plate_001", stiffness=150.0))
    assert soft.loc["plate_001", "secant_stiffness", "25 mm"].value == pytest.approx(150.0)


def test_what_is_missing_is_never_a_number():
    bare = record("plate_001", message="spoke not found again", plate_stress=None, extra={})
    table = responses(bare, settings=TyreResponseSettings(loads_n=(9000.0,)))
    for name in ("plate_largest_mises", "plate_factor_tsai_wu", "rubber_largest_energy_density"):
        row = table.loc["plate_001", name, "5000 N"]
        assert np.isnan(row.value)
        assert row.status == "not assessed"
        assert row.note == "spoke not found again"
    assert table.loc["plate_001", "contact_length", "5000 N"].status == "not assessed"
    assert table.loc["plate_001", "secant_stiffness", "9000 N"].status == "not reached"
    assert table.loc["plate_001", "plate_mass", ""].status == "not assessed"


def test_a_contact_of_too_few_points_says_so():
    coarse = record("plate_001", extra={"contact_cells": 3.1, "largest_spoke_force_n": 90.0})
    table = responses(coarse)
    for name in ("contact_length", "largest_pressure", "mean_pressure"):
        row = table.loc["plate_001", name, "5000 N"]
        assert row.status == "not assessed"
        assert "only 3.1 contact points long" in row.note
    assert table.loc["plate_001", "largest_spoke_force", "5000 N"].status == "ok"


def test_margins_need_tested_strengths_and_the_mass_a_density():
    table = responses(
        record("plate_001"), settings=TyreResponseSettings(plate_density_kg_per_m3=1550)
    )
    assert table.loc["plate_001", "plate_mass", ""].value == pytest.approx(0.93)
    # across the fibres 10 of 50 MPa uses more of its strength than any other stress
    assert table.loc["plate_001", "plate_factor_maximum_stress", "5000 N"].value == pytest.approx(
        5.0
    )
    untested = responses(record("plate_001"), strengths=PlyStrengths(xt_mpa=2000.0))
    row = untested.loc["plate_001", "plate_factor_tsai_wu", "5000 N"]
    assert row.status == "not assessed"
    assert "xc, yt, yc, s12" in row.note


def test_cases_that_failed_and_solvers_without_a_curve_are_left_out():
    failed = record("plate_002", status=Status.DIVERGED)
    records = [record("plate_001"), failed, record("plate_003", curve=None)]
    assert set(responses(*records).index.get_level_values("case_id")) == {"plate_001"}
    assert check(tyre_curves(records), TyreCurves, "")["case_id"].unique().tolist() == ["plate_001"]
    assert len(check(plate_stress(records), PlateStress, "")) == 4
    assert tyre_curves([failed]).empty
    assert plate_stress([failed]).empty


@pytest.fixture
def solved(compared):
    records = [record("plate_032"), record("plate_001", stiffness=300.0)]
    tables = {
        "tyre_responses.csv": responses(*records).reset_index()[
            list(TyreResponses.to_schema().columns)
        ],
        "tyre_curves.csv": check(tyre_curves(records), TyreCurves, ""),
        "plate_stress.csv": check(plate_stress(records), PlateStress, ""),
    }
    return replace(compared, tables={**compared.tables, **tables})


def test_the_section_draws_figure_10_and_names_what_is_missing(solved, monkeypatch):
    monkeypatch.setattr("nptcs.report.drawing.to_svg", lambda figure: "<svg/>")
    section = tyre_section(solved, sheets_of(solved))
    words = " ".join(block.text for block in section.blocks if isinstance(block, Text))
    assert "89.5 MPa" in words
    assert "88.0 MPa" in words
    # the study asks for a neutral line, but no outlines are there
    assert "No tyre is drawn with its spokes" in words
    (listed,) = (block for block in section.blocks if isinstance(block, Listing))
    assert any(
        "2 tyres, not reached" in line and "vertical stiffness at 25 mm" in line
        for line in listed.items
    )
    assert "88.0 MPa (plate_032, fe_tyre_paper)" in words
    curves, faces = (block for block in section.blocks if isinstance(block, Plots))
    assert len(curves.plots) == 1
    assert [p.alt.split(", ")[1] for p in faces.plots] == ["plate_032"]
    sections = build_sections(solved, sheets_of(solved))
    built = next(s for s in sections if s.identifier is ReportSection.TYRE)
    (folded,) = (block for block in built.blocks if isinstance(block, MoreTables))
    assert all(isinstance(table, TableView) for table in folded.tables)


def test_the_fiducial_plates_are_drawn_next_to_the_most_stressed_ones(solved, monkeypatch):
    monkeypatch.setattr("nptcs.report.drawing.to_svg", lambda figure: "<svg/>")
    stress = solved.table(PlateStress)
    larger = stress.assign(
        mises_mpa=stress["mises_mpa"] * np.where(stress["case_id"] == "plate_001", 2.0, 1.0)
    )
    other = replace(solved, tables={**solved.tables, "plate_stress.csv": larger})
    *_, faces = (b for b in tyre_section(other, sheets_of(other)).blocks if isinstance(b, Plots))
    assert [p.alt.split(", ")[1] for p in faces.plots] == ["plate_032", "plate_001"]


def test_the_fiducial_case_alone_is_compared_with_the_paper(solved):
    cases = solved.table(Cases)
    without = cases[cases["angle_deg"] != 45.0]
    less = replace(solved, tables={**solved.tables, "cases.csv": without})
    words = " ".join(
        b.text for b in tyre_section(less, sheets_of(less)).blocks if isinstance(b, Text)
    )
    assert "89.5 MPa as the largest" not in words


def test_figures_show_their_data(solved):
    figure = load_displacement(solved.table(TyreCurves), solved.table(Cases).iloc[:0], "plate")
    labels = [text.get_text() for text in figure.legends[0].get_texts()]
    assert labels == ["plate_001: 300 N/mm", "plate_032: 265 N/mm"]
    stress = solved.table(PlateStress)
    faces = plate_faces(stress[stress["case_id"] == "plate_032"], "plate_032")
    drawn = np.concatenate([line.get_ydata() for line in faces.axes[0].get_lines()])
    assert set(PLATES["mises_mpa"]) | {89.5} <= set(drawn)
    assert isinstance(stress, pd.DataFrame)
