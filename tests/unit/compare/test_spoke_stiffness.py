"""Single spokes against table 10, and the neutral lines of named cases."""

from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from nptcs.campaign.record import CaseRecord
from nptcs.compare.neutral_line import neutral_lines
from nptcs.compare.spoke_stiffness import spoke_curves, spoke_lines
from nptcs.solvers.contract import SPOKE_RESPONSES, SolverResult, neutral_line_columns
from nptcs.tables.io import check, read_table, write_table
from nptcs.tables.published.inputs import PublishedSpokeStiffness
from nptcs.tables.tyres.neutral_line import NeutralLine
from nptcs.tables.tyres.spoke_stiffness import SpokeCurves, SpokeLines

TABLE_10 = Path(__file__).parents[3] / "raw_data/published/table10_spoke_stiffness.csv"
PLACE = [-20.0, -10.0, 0.0, 2.0, 4.0]
FORCE = [-250.0, -150.0, 0.0, 60.0, 140.0]


def record(result, c10=1.0, study="spoke", case_id="spoke_001", solver="fe_spoke", load_n=None):
    plate = {"spacing_mm": 15.0, "thickness_mm": 1.8, "angle_deg": 45.0}
    return CaseRecord(
        study=study,
        case_id=case_id,
        solver=solver,
        solver_version="1",
        key="k",
        values={"spoke_c10_mpa": c10, **plate},
        load_n=load_n,
        wall_time_s=1.0,
        result=result,
    )


REPORTED = {
    "tension_stiffness_n_per_mm": 34.0,
    "tension_r2_uncentred": 0.9966,
    "tension_r2_centred": 0.9919,
    "compression_stiffness_n_per_mm": 13.0,
    "compression_r2_uncentred": 0.9941,
    "compression_r2_centred": 0.984,
}


@pytest.fixture
def spoke():
    curve = {"displacement_mm": PLACE, "force_n": FORCE}
    return record(SolverResult(status="ok", extra=REPORTED, curve=curve))


@pytest.fixture
def published():
    return {"spoke": read_table(TABLE_10, PublishedSpokeStiffness)}


def test_the_reported_lines_are_compared_with_table_10(spoke, published):
    (row,) = check(spoke_lines([spoke], published), SpokeLines, "lines").to_dict("records")
    assert {name: row[name] for name in SPOKE_RESPONSES} == REPORTED
    assert row["published_tension_stiffness_n_per_mm"] == 30.2
    assert row["tension_difference_percent"] == pytest.approx(100 * (34 / 30.2 - 1))
    assert row["compression_difference_percent"] == pytest.approx(100 * (13 / 13.26 - 1))
    assert row["published_compression_r2"] == 0.9882


def test_a_spoke_that_failed_is_a_row_with_its_status(published):
    failed = record(SolverResult(status="diverged", message="no equilibrium"))
    (row,) = check(spoke_lines([failed], published), SpokeLines, "lines").to_dict("records")
    assert row["status"] == "diverged"
    assert np.isnan(row["tension_stiffness_n_per_mm"])
    assert row["published_tension_stiffness_n_per_mm"] == 30.2
    assert spoke_curves([failed]).empty


@pytest.mark.parametrize("study", ["spoke", "other"])
def test_only_rubbers_of_a_study_that_names_table_10_are_compared_with_it(spoke, published, study):
    changes = {"study": study, "values": {**spoke.values, "spoke_c10_mpa": 1.5}}
    if study == "other":
        changes["values"] = spoke.values
    (row,) = spoke_lines([spoke.model_copy(update=changes)], published).to_dict("records")
    assert np.isnan(row["published_tension_stiffness_n_per_mm"])
    assert np.isnan(row["tension_difference_percent"])


def test_curves_are_kept_point_by_point(tmp_path, spoke):
    write_table(tmp_path / "curves.csv", spoke_curves([spoke]), SpokeCurves)
    back = read_table(tmp_path / "curves.csv", SpokeCurves)
    assert list(back["displacement_mm"]) == PLACE
    assert list(back["force_n"]) == FORCE


def test_without_spokes_the_tables_are_empty_but_have_all_columns(tmp_path):
    for table, contract in (
        (spoke_lines([], {}), SpokeLines),
        (spoke_curves([]), SpokeCurves),
        (neutral_lines([], []), NeutralLine),
    ):
        write_table(tmp_path / "table.csv", table, contract)
        assert read_table(tmp_path / "table.csv", contract).empty


def test_a_neutral_line_runs_once_around_from_the_top():
    line = neutral_line_columns(
        [0.0, 90.0, 180.0, 270.0], [1.0, 2.0, 3.0, 1 / 3], [-0.0, 1e-9, 0, 0]
    )
    assert line["theta_deg"] == [-90.0, 0.0, 90.0, 180.0]
    assert line["radial_mm"] == [0.333333, 1.0, 2.0, 3.0]
    assert str(line["tangential_mm"][1]) == "0.0"


def test_only_named_cases_with_a_shape_are_gathered():
    line = neutral_line_columns([-90.0, 0.0, 90.0], [1.0, -9.0, 1.0], [0.0, 0.0, 0.0])
    solved = SolverResult(
        status="ok", neutral_line=line, vertical_stiffness_n_per_mm=260.0, displacement_mm=19.2
    )
    records = [
        record(solved, case_id=case_id, solver=solver, load_n=5000.0)
        for case_id, solver in (("r_001", "lca"), ("r_002", "lca"), ("r_002", "fe_tyre"))
    ]
    records.append(record(SolverResult(status="diverged"), case_id="r_002", solver="published"))
    table = check(neutral_lines(records, ["r_002"]), NeutralLine, "lines")
    assert list(table["solver"].unique()) == ["lca", "fe_tyre"]
    assert set(table["case_id"]) == {"r_002"}
    assert list(table["radial_mm"][:3]) == [1.0, -9.0, 1.0]


def test_columns_of_a_result_must_be_equally_long():
    for name in ("curve", "neutral_line"):
        with pytest.raises(ValueError, match="equally long"):
            SolverResult(status="ok", **{name: {"a": [1.0], "b": [1.0, 2.0]}})


def test_published_tables_have_each_rubber_once(published):
    assert isinstance(published["spoke"], pd.DataFrame)
    assert list(published["spoke"]["spoke_c10_mpa"]) == [1, 2, 3, 4, 5]
