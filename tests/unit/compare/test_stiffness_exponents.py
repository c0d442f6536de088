"""Exponents of the stiffness with respect to each modulus, for laws whose exponents are known."""

import itertools

import numpy as np
import pandas as pd
import pytest

from nptcs.compare.published_stiffness import Comparison
from nptcs.compare.stiffness_exponents import stiffness_exponents
from nptcs.tables.io import check, empty_table
from nptcs.tables.published.stiffness import StiffnessAgainstPublished, StiffnessExponents

FACTORS = ("shear_band_c10_mpa", "spoke_c10_mpa", "spacing_mm")


def law(computed, published):
    """Cases of K = 100 band^a spokes^b of each kind, at two spacings."""
    levels = itertools.product((4.0, 4.5, 5.0), (1.0, 2.0, 5.0), (10.0, 20.0))
    cases = pd.DataFrame(list(levels), columns=list(FACTORS))
    for name, (a, b) in (("computed", computed), ("published", published)):
        stiffness = 100.0 * cases[FACTORS[0]] ** a * cases[FACTORS[1]] ** b
        cases[f"{name}_stiffness_n_per_mm"] = stiffness
    ratio = cases["computed_stiffness_n_per_mm"] / cases["published_stiffness_n_per_mm"]
    return cases.assign(
        study="rubbers",
        solver="mine",
        status="ok",
        used_for_calibration=False,
        case=range(1, len(cases) + 1),
        case_id=[f"rubbers_{number:03d}" for number in range(1, len(cases) + 1)],
        difference_percent=100.0 * (ratio - 1.0),
    )


def exponents(cases, factors=FACTORS):
    comparison = {"rubbers": Comparison(cases, factors, ("mine",), {})}
    return check(stiffness_exponents(cases, comparison), StiffnessExponents, "exponents")


def test_every_row_of_a_power_law_has_its_exponent():
    table = exponents(law((0.37, 0.54), (0.40, 0.51)))
    assert set(table["factor"]) == {"shear_band_c10_mpa", "spoke_c10_mpa"}
    for factor, wanted in (("shear_band_c10_mpa", (0.37, 0.40)), ("spoke_c10_mpa", (0.54, 0.51))):
        rows = table[table["factor"] == factor]
        assert rows["computed_exponent"].to_numpy() == pytest.approx(wanted[0])
        assert rows["published_exponent"].to_numpy() == pytest.approx(wanted[1])
        assert rows["exponent_difference"].to_numpy() == pytest.approx(wanted[0] - wanted[1])
        # all levels and both steps, at six combinations of the other factors
        assert len(rows) == 3 * 6
        assert list(rows["levels"][:3]) == [3, 2, 2]
    first = table.iloc[0]
    assert first["held"] == "spoke_c10_mpa 1, spacing_mm 10"
    assert (first["low_mpa"], first["high_mpa"]) == (4.0, 5.0)


def test_one_case_too_stiff_shows_in_its_two_steps():
    cases = law((0.4, 0.5), (0.4, 0.5))
    odd = np.all(cases[list(FACTORS)].to_numpy() == [4.5, 1.0, 10.0], axis=1)
    cases.loc[odd, "published_stiffness_n_per_mm"] *= 1.01
    rows = exponents(cases)
    mine = rows[(rows["factor"] == FACTORS[0]) & (rows["held"] == "spoke_c10_mpa 1, spacing_mm 10")]
    steps = mine[mine["levels"] == 2]["published_exponent"].to_numpy()
    shift = np.log(1.01) / np.log([4.5 / 4.0, 5.0 / 4.5])
    assert steps == pytest.approx([0.4 + shift[0], 0.4 - shift[1]])


def test_cases_without_both_values_do_not_count():
    cases = law((0.4, 0.5), (0.4, 0.5))
    cases.loc[cases["spoke_c10_mpa"] > 1.0, "difference_percent"] = np.nan
    table = exponents(cases)
    assert set(table["factor"]) == {"shear_band_c10_mpa"}


def test_a_study_of_one_modulus_holds_no_other_factor():
    cases = law((0.4, 0.5), (0.4, 0.5))
    alone = cases[(cases["spoke_c10_mpa"] == 1.0) & (cases["spacing_mm"] == 10.0)]
    table = exponents(alone, ("shear_band_c10_mpa",))
    assert list(table["held"]) == ["", "", ""]
    assert table["computed_exponent"].to_numpy() == pytest.approx(0.4)


def test_factors_other_than_moduli_have_no_exponent():
    assert exponents(law((0.4, 0.5), (0.4, 0.5)), ("spacing_mm",)).empty
    nothing = empty_table(StiffnessAgainstPublished)
    assert stiffness_exponents(nothing, {}).empty
