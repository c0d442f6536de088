"""Computed stiffness against published stiffness, checked by hand."""

import numpy as np
import pandas as pd
import pytest

from nptcs.compare.published_stiffness import (
    Comparison,
    compare_published,
    stiffness_by_level,
    stiffness_errors,
)
from nptcs.errors import InputError
from nptcs.tables.io import check, empty_table, read_table, write_table
from nptcs.tables.published.stiffness import (
    StiffnessAgainstPublished,
    StiffnessByLevel,
    StiffnessErrors,
)

PUBLISHED = {"s_001": 100.0, "s_002": 200.0, "s_003": 400.0, "s_004": 500.0}
OURS = {"s_001": 101.0, "s_002": 190.0, "s_003": 408.0, "s_004": None}


def cases(ours=OURS, study="s", solver="mine"):
    rows = [
        {
            "study": study,
            "case_id": case_id,
            "solver": name,
            "status": "ok" if stiffness else "diverged",
            "vertical_stiffness_n_per_mm": stiffness,
        }
        for name, values in (("published", PUBLISHED), (solver, ours))
        for case_id, stiffness in values.items()
    ]
    return pd.DataFrame(rows)


@pytest.fixture
def comparison():
    design = pd.DataFrame(
        {
            "case_id": list(PUBLISHED),
            "case": [1, 2, 3, 4],
            "a": [1.0, 1.0, 2.0, 2.0],
            "b": [5.0, 6.0, 5.0, 6.0],
            "fixed_mm": 7.0,
        }
    )
    return Comparison(design, ("a", "b"), ("mine",), {"mine": (2,)})


@pytest.fixture
def table(comparison):
    return check(compare_published(cases(), {"s": comparison}), StiffnessAgainstPublished, "table")


def test_each_case_is_next_to_the_published_one(table):
    np.testing.assert_allclose(table["difference_percent"][:3], [1.0, -5.0, 2.0])
    assert list(table["used_for_calibration"]) == [False, True, False, False]
    assert list(table)[-3:] == ["a", "b", "fixed_mm"]


def test_a_failed_case_is_a_row_with_its_status(table):
    failed = table.iloc[3]
    assert failed["status"] == "diverged"
    assert failed["published_stiffness_n_per_mm"] == 500.0
    assert np.isnan(failed["computed_stiffness_n_per_mm"])
    assert np.isnan(failed["difference_percent"])


def test_cases_are_matched_by_name_not_by_position(comparison):
    shuffled = cases().iloc[::-1]
    table = compare_published(shuffled, {"s": comparison})
    np.testing.assert_allclose(table["difference_percent"][:3], [1.0, -5.0, 2.0])


def test_blind_cases_are_summed_up_apart(table):
    errors = check(stiffness_errors(table), StiffnessErrors, "errors")
    blind, calibration = errors.to_dict("records")
    assert (blind["group"], blind["cases"], blind["compared"]) == ("blind", 3, 2)
    assert blind["mean_percent"] == pytest.approx(1.5)
    assert blind["mean_absolute_percent"] == pytest.approx(1.5)
    assert (blind["largest_percent"], blind["largest_case_id"]) == (pytest.approx(2.0), "s_003")
    assert (calibration["group"], calibration["compared"]) == ("calibration", 1)
    assert calibration["largest_percent"] == pytest.approx(-5.0)


def test_signs_do_not_cancel_in_the_mean_absolute(comparison):
    ours = {**OURS, "s_001": 97.0}
    errors = stiffness_errors(compare_published(cases(ours), {"s": comparison}))
    blind = errors[errors["group"] == "blind"].iloc[0]
    assert blind["mean_percent"] == pytest.approx(-0.5)
    assert blind["mean_absolute_percent"] == pytest.approx(2.5)
    assert blind["largest_percent"] == pytest.approx(-3.0)


def test_a_solver_that_solved_nothing_has_a_row_without_numbers(comparison):
    nothing = compare_published(cases(dict.fromkeys(PUBLISHED)), {"s": comparison})
    errors = check(stiffness_errors(nothing), StiffnessErrors, "errors")
    assert list(errors["compared"]) == [0, 0]
    assert errors["mean_percent"].isna().all()
    assert list(errors["largest_case_id"]) == ["", ""]
    levels = stiffness_by_level(nothing, {"s": comparison})
    assert check(levels, StiffnessByLevel, "levels").empty


def test_main_effects_are_over_the_same_cases(table, comparison):
    levels = stiffness_by_level(table, {"s": comparison})
    levels = check(levels, StiffnessByLevel, "levels").set_index(["factor", "level"])
    # at b = 6 the case with a = 2 failed: neither level is averaged over it
    low, high = levels.loc["a", 1.0], levels.loc["a", 2.0]
    assert (low["compared"], high["compared"]) == (1, 1)
    assert (low["computed_mean_n_per_mm"], low["published_mean_n_per_mm"]) == (101.0, 100.0)
    assert high["computed_change_percent"] == pytest.approx(100 * (408 / 101 - 1))
    assert high["published_change_percent"] == pytest.approx(300.0)


def test_main_effects_of_a_whole_study_are_means(comparison):
    table = compare_published(cases({**OURS, "s_004": 490.0}), {"s": comparison})
    levels = stiffness_by_level(table, {"s": comparison}).set_index(["factor", "level"])
    low, high = levels.loc["a", 1.0], levels.loc["a", 2.0]
    assert (low["compared"], high["compared"]) == (2, 2)
    assert low["computed_mean_n_per_mm"] == pytest.approx(145.5)
    assert high["published_mean_n_per_mm"] == 450.0
    assert high["published_change_percent"] == pytest.approx(200.0)
    assert low["published_change_percent"] == 0.0
    assert low["mean_difference_percent"] == pytest.approx(-2.0)
    assert low["lowest_difference_percent"] == pytest.approx(-5.0)
    assert low["highest_difference_percent"] == pytest.approx(1.0)


def test_one_factor_with_a_failed_level_has_no_main_effect(comparison):
    alone = Comparison(comparison.design.assign(c=[1.0, 2.0, 3.0, 4.0]), ("c",), ("mine",), {})
    table = compare_published(cases(), {"s": alone})
    assert stiffness_by_level(table, {"s": alone}).empty
    whole = compare_published(cases({**OURS, "s_004": 490.0}), {"s": alone})
    assert len(stiffness_by_level(whole, {"s": alone})) == 4


def test_without_published_studies_the_tables_are_empty_but_have_all_columns(tmp_path):
    nothing = check(compare_published(cases(), {}), StiffnessAgainstPublished, "table")
    for name, table, contract in (
        ("table", nothing, StiffnessAgainstPublished),
        ("errors", stiffness_errors(nothing), StiffnessErrors),
        ("levels", stiffness_by_level(nothing, {}), StiffnessByLevel),
    ):
        write_table(tmp_path / name, table, contract)
        back = read_table(tmp_path / name, contract)
        assert list(back) == list(empty_table(contract))
        assert back.empty


def test_tables_are_the_same_after_a_round_trip(tmp_path, table):
    write_table(tmp_path / "table.csv", table, StiffnessAgainstPublished)
    pd.testing.assert_frame_equal(
        read_table(tmp_path / "table.csv", StiffnessAgainstPublished), table
    )


def test_the_contract_refuses_a_case_twice(table):
    with pytest.raises(InputError):
        check(pd.concat([table, table], ignore_index=True), StiffnessAgainstPublished, "table")
