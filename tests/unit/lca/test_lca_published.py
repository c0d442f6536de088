"""Against the paper: tables 7, 10 and 11."""

import numpy as np
import pytest

from nptcs import lca
from nptcs.compare.lca import lca_against_fem, lca_validation, ring_neutral_lines
from nptcs.tables.io import check
from nptcs.tables.published.lca_validation import LcaAgainstFem, LcaNeutralLine, LcaValidation


@pytest.fixture
def rows(published, tyre):
    table = lca_validation(
        published["table_10"], published["table_11"], published["load_errors"], tyre
    )
    return check(table, LcaValidation, "lca_validation.csv")


def test_sandwich_section_meets_all_fifteen_numbers_of_table_11_within_a_percent(rows):
    table_11 = rows[(rows["section"] == "sandwich") & (rows["load_n"] == 5000)]
    assert len(table_11) == 5
    for name in ("theta_c", "theta_t", "displacement"):
        assert table_11[f"{name}_difference_percent"].abs().max() < 1.0


def test_exact_values_at_table_11(rows):
    table_11 = rows[(rows["section"] == "sandwich") & (rows["load_n"] == 5000)]
    expected = {
        "theta_c_deg": [4.569, 4.384, 4.272, 4.191, 4.128],
        "theta_t_deg": [56.452, 49.128, 45.174, 42.554, 40.601],
        "displacement_mm": [20.741, 14.278, 11.648, 10.151, 9.157],
        "stiffness_n_per_mm": [241.06, 350.20, 429.27, 492.56, 546.06],
    }
    for name, values in expected.items():
        digits = 2 if name == "stiffness_n_per_mm" else 3
        np.testing.assert_allclose(table_11[name], values, rtol=0, atol=0.51 * 10**-digits)


def test_printed_section_misses_table_11(rows):
    table_11 = rows[(rows["section"] == "printed") & (rows["load_n"] == 5000)]
    assert table_11["theta_c_difference_percent"].abs().min() > 4.5
    assert table_11["theta_t_difference_percent"].abs().max() > 5


def test_published_values_are_given_at_their_own_load_only(rows):
    elsewhere = rows[rows["load_n"] != 5000]
    assert elsewhere["published_displacement_mm"].isna().all()
    assert elsewhere["displacement_difference_percent"].isna().all()
    assert set(rows["load_n"]) == {3000, 4000, 5000, 6000}
    assert rows["balance_residual"].abs().max() < 1e-12


def test_model_is_softer_than_all_fifteen_finite_element_results(published, tyre):
    table = lca_against_fem(published["table_10"], published["table_7"], tyre)
    table = check(table, LcaAgainstFem, "lca_fem.csv")
    difference = table.loc[table["section"] == "sandwich", "fem_difference_percent"]
    assert len(difference) == 15
    assert difference.between(-7.7, -2.8).all()
    assert difference.abs().mean() == pytest.approx(5.16, abs=0.01)


def test_printed_section_constants_are_those_of_the_paper(tyre):
    section = lca.ShearBandSection.from_tyre(tyre, 5.0, "printed")
    area = section.shear_stiffness_n / 10
    inertia = section.bending_stiffness_n_mm2 / (section.axial_stiffness_n / area)
    assert area == pytest.approx(2687.5)
    assert inertia == pytest.approx(1.035e7, rel=1e-3)


def test_sandwich_section_constants(tyre):
    section = lca.ShearBandSection.from_tyre(tyre, 5.0)
    assert section.axial_stiffness_n == pytest.approx(2.711e7, rel=1e-4)
    assert section.shear_stiffness_n == 30100
    assert section.bending_stiffness_n_mm2 == pytest.approx(1.0554e9, rel=1e-4)


def test_ring_shapes_are_flat_on_the_ground_and_symmetric(published, tyre):
    shapes = check(
        ring_neutral_lines(published["table_10"], published["table_11"], tyre),
        LcaNeutralLine,
        "shape.csv",
    )
    for _, shape in shapes.groupby("spoke_c10_mpa"):
        contact = shape.loc[shape["region"] == "contact", "y_mm"]
        assert np.ptp(contact) < 1e-9
        assert shape["y_mm"].min() == pytest.approx(contact.min(), abs=1e-9)
        np.testing.assert_allclose(shape["x_mm"], -shape["x_mm"][::-1], atol=1e-9)
