"""A table of designs in, a table of results out; predicted spokes."""

from dataclasses import replace

import numpy as np
import pandas as pd
import pytest

from nptcs.config.solvers.ring import RingOptions
from nptcs.config.solvers.tyre import TyreGeometry
from nptcs.errors import InputError
from nptcs.ring.batch import NUMBERS, NamedTables, solve_table
from nptcs.ring.solution import press_through_loads
from nptcs.ring.surrogate.model import SpokeSurrogate
from nptcs.ring.surrogate.source import PredictedSpokes, with_table
from nptcs.ring.tyre import ring_tyre
from nptcs.tables.laboratory.material_card import PUBLISHED_PLY

TYRE, OPTIONS = TyreGeometry(), RingOptions()


def solved(rows, spokes, **more):
    return solve_table(pd.DataFrame(rows), spokes, TYRE, OPTIONS, kernel="numpy", **more)


@pytest.fixture(scope="module")
def named(table):
    return NamedTables({"invented": table})


def row(**change):
    return {"spoke": "invented", "shear_band_c10_mpa": 5.0, "load_n": 2000.0, **change}


def test_a_row_is_the_single_tyre(table, named):
    found = solved([row(note="kept")], named).iloc[0]
    single = press_through_loads(
        ring_tyre(TYRE, table, 5.0, OPTIONS, kernel="numpy"), [500, 1000, 1500, 2000]
    )
    assert found["displacement_mm"] == pytest.approx(single[-1].rise_mm, rel=1e-9)
    assert found["vertical_stiffness_n_per_mm"] == pytest.approx(2000 / single[-1].rise_mm)
    assert found["displacement_standard_error_mm"] == 0.0
    assert (found["status"], found["note"]) == ("ok", "kept")


def test_workers_do_not_change_results(named):
    rows = [row(shear_band_c10_mpa=c10) for c10 in (3.0, 4.0, 5.0, 6.0)]
    one, two = solved(rows, named), solved(rows, named, workers=2)
    pd.testing.assert_frame_equal(one, two)
    assert one["displacement_mm"].is_monotonic_decreasing


def test_columns_reach_the_tyre(named):
    base, soft, thick, grippy, stiff = solved(
        [
            row(),
            row(tread_c10_mpa=2.0),
            row(outer_diameter_mm=650.0),
            row(friction=0.0),
            row(spoke_factor=1.2),
        ],
        named,
    )["displacement_mm"]
    assert soft > base
    assert thick != base
    assert grippy > base
    assert stiff < base


@pytest.mark.parametrize(
    ("change", "status", "word"),
    [
        ({"spoke": "unknown"}, "bad_input", "unknown"),
        ({"load_n": -1.0}, "bad_input", "above zero"),
        ({"shear_band_c10_mpa": "five"}, "bad_input", "not a number"),
        ({"load_n": None}, "bad_input", "empty"),
        ({"wire_layers": 1}, "bad_input", "wire_layers"),
        ({"rim_diameter_mm": 400.0}, "bad_input", "distance between rim and band"),
        ({"load_n": 1e5}, "beyond_table", "outside the table's range"),
    ],
)
def test_a_row_that_fails_says_why_and_the_others_are_solved(named, change, status, word):
    found = solved([row(), row(**change)], named)
    assert found["status"].tolist() == ["ok", status]
    assert word in found["message"].iloc[1]
    assert found[list(NUMBERS)].iloc[1].isna().all()


@pytest.mark.parametrize("column", ["status", "tread_width_mm", "band_radius_mm"])
def test_columns_that_cannot_be_are_refused(named, column):
    with pytest.raises(InputError, match=column):
        solved([row(**{column: 215.0})], named)


def test_missing_columns_are_refused(named):
    with pytest.raises(InputError, match="load_n"):
        solved([{"spoke": "invented", "shear_band_c10_mpa": 5.0}], named)


@pytest.fixture(scope="module")
def surrogate(designs, table, law):
    return SpokeSurrogate(designs, [law(design, table) for design in designs], PUBLISHED_PLY)


def test_a_left_out_spoke_is_predicted(surrogate, table, law):
    design = [16.0, 1.7, 40.0, 2.2]
    predicted, true = surrogate.predict(design).table, law(design, table)
    tyres = [ring_tyre(TYRE, spoke, 5.0, OPTIONS, kernel="numpy") for spoke in (predicted, true)]
    rises = [press_through_loads(tyre, [1000.0, 2000.0])[-1].rise_mm for tyre in tyres]
    assert rises[0] == pytest.approx(rises[1], rel=0.003)


def test_a_known_spoke_is_predicted_with_a_small_error(surrogate, designs, table, law):
    inside = surrogate.predict(designs[0])
    true = law(designs[0], table)
    scale = np.abs(true.coefficients).max()
    np.testing.assert_allclose(inside.table.coefficients, true.coefficients, atol=1e-3 * scale)
    between = surrogate.predict([16.0, 1.7, 40.0, 2.2])
    assert np.linalg.norm(between.modes) > np.linalg.norm(inside.modes)


@pytest.mark.parametrize(
    ("design", "column"),
    [
        ([25.0, 1.7, 40.0, 2.2], "plate_count"),
        ([16.0, 0.9, 40.0, 2.2], "thickness_mm"),
        ([16.0, 1.7, 95.0, 2.2], "angle_deg"),
        ([16.0, 1.7, 40.0, 7.0], "spoke_c10_mpa"),
    ],
)
def test_outside_its_box_it_refuses(surrogate, design, column):
    with pytest.raises(InputError, match=column):
        surrogate.predict(design)


def test_its_uncertainty_reaches_the_displacement(surrogate):
    design = {
        "plate_count": 16, "thickness_mm": 1.7, "angle_deg": 40.0, "spoke_c10_mpa": 2.2,
        "shear_band_c10_mpa": 5.0, "load_n": 1000.0,
    }  # fmt: skip
    outside = {**design, "plate_count": 40}
    found = solved([design, outside], PredictedSpokes(surrogate))
    assert found["status"].tolist() == ["ok", "bad_input"]
    assert "surrogate" in found["message"].iloc[1]
    predicted = surrogate.predict([16.0, 1.7, 40.0, 2.2])
    tyre = ring_tyre(TYRE, predicted.table, 5.0, OPTIONS, kernel="numpy")
    changes = []
    for mode in predicted.modes:
        ends = [
            press_through_loads(
                with_table(
                    tyre,
                    replace(
                        predicted.table, coefficients=predicted.table.coefficients + sign * mode
                    ),
                ),
                [500.0, 1000.0],
            )[-1].rise_mm
            for sign in (1, -1)
        ]
        changes.append((ends[0] - ends[1]) / 2)
    expected = np.sqrt(np.sum(np.square(changes)))
    assert expected > 0
    error = found["displacement_standard_error_mm"].iloc[0]
    assert error == pytest.approx(expected, rel=0.02, abs=1e-8)


def test_it_names_the_spoke_that_would_help_most(surrogate, designs, table, law):
    """With a corner of the box left empty, it asks for a spoke near that corner."""
    sparse = designs[~((designs[:, 2] > 55) & (designs[:, 3] > 2.5))]
    own = SpokeSurrogate(
        sparse, [law(design, table) for design in sparse], PUBLISHED_PLY, surrogate.kernels
    )
    own.low, own.high = surrogate.low, surrogate.high
    design, part = own.next_design()
    assert design["angle_deg"] > 50
    assert design["spoke_c10_mpa"] > 2.0
    assert 0 < part < 1


def test_too_few_or_unlike_tables_are_refused(designs, table, law):
    tables = [law(design, table) for design in designs]
    with pytest.raises(InputError, match="too few"):
        SpokeSurrogate(designs[:12], tables[:12], PUBLISHED_PLY)
    tables[3] = replace(tables[3], low=tables[3].low * [0.8, 1.0, 1.0])
    with pytest.raises(InputError, match="ranges differ"):
        SpokeSurrogate(designs, tables, PUBLISHED_PLY)
