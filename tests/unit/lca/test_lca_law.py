"""Spokes that follow a curve, and spokes that are not smeared."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from nptcs import lca
from nptcs.errors import InputError
from nptcs.lca.any_spokes.with_law import edge_at
from nptcs.lca.spokes.law_table import SpokeLawTable
from nptcs.lca.spokes.stiffness_table import OutOfRangeError


def softening(elongation):
    """Force of a spoke that buckles in compression and stiffens in tension (N)."""
    e = np.asarray(elongation, dtype=float)
    return np.where(e < 0, 300 * np.tanh(e / 18), 30 * e * (1 + 0.04 * e))


def tabulated(points=1500):
    """The same as a law, tabulated so finely that its interpolation error is below 1e-7."""
    elongation = np.concatenate([np.linspace(-40, 0, points), np.linspace(0, 8, points)[1:]])
    return lca.SpokeLaw(elongation, softening(elongation))


@settings(max_examples=40, deadline=None)
@given(
    steps=st.lists(st.tuples(st.floats(0.01, 5), st.floats(0.1, 300)), min_size=2, max_size=8),
    left=st.integers(1, 7),
)
def test_law_is_monotone_passes_its_points_and_has_its_own_slope(steps, left):
    left = min(left, len(steps) - 1)
    elongation, force = np.cumsum(np.array([(0.0, 0.0), *steps]), axis=0).T
    law = lca.SpokeLaw(elongation - elongation[left], force - force[left])
    at_points, _ = law.evaluate(law.elongation_mm)
    np.testing.assert_allclose(at_points, law.force_n, atol=1e-9)
    fine = np.linspace(law.elongation_mm[0] - 1, law.elongation_mm[-1] + 1, 4001)
    values, slopes = law.evaluate(fine)
    assert (np.diff(values) > -1e-9).all()
    inside = np.abs(fine[:, None] - law.elongation_mm).min(axis=1) > 1e-5
    difference = (law.evaluate(fine + 1e-6)[0] - law.evaluate(fine - 1e-6)[0]) / 2e-6
    np.testing.assert_allclose(difference[inside], slopes[inside], rtol=1e-3, atol=1e-3)


@pytest.mark.parametrize(
    ("elongation", "force", "text"),
    [
        ([-1, 0, 1], [-1, 0], "of equal length"),
        ([-1, 0, 1], [-1, 0, np.nan], "finite numbers"),
        ([-1, 0, 0, 1], [-1, 0, 0, 1], "must increase"),
        ([-2, -1, 0, 1], [-1, -2, 0, 1], "must increase"),
        ([-1, 1], [-1, 1], "must contain the origin"),
        ([0, 1], [0, 1], "must contain the origin"),
    ],
)
def test_curves_that_are_not_a_law_are_refused(elongation, force, text):
    with pytest.raises(InputError, match=text):
        lca.SpokeLaw(np.array(elongation, float), np.array(force, float))


def test_two_tests_join_at_the_origin():
    law = lca.SpokeLaw.from_curves([0, 2, 4], [0, 60, 121], [0, 10, 20], [0, 130, 240])
    np.testing.assert_array_equal(law.elongation_mm, [-20, -10, 0, 2, 4])
    np.testing.assert_array_equal(law.force_n, [-240, -130, 0, 60, 121])


@pytest.mark.parametrize("load", [300.0, 5000.0, 9000.0])
def test_two_straight_lines_are_the_linear_model(section, spokes, load):
    exact = lca.solve(section, spokes, load_n=load)
    law = lca.solve_law(section, lca.SpokeLaw.linear(spokes, 80), load_n=load, contact="paper")
    for name in ("displacement_mm", "theta_c_deg", "theta_t_deg", "contact_force_n"):
        assert getattr(law, name) == pytest.approx(getattr(exact, name), rel=1e-10)
    assert abs(law.balance_residual) < 1e-12
    # and everywhere on the ring
    points = law.points()
    state = exact.at(points["theta_deg"])
    for name in ("u_r_mm", "u_theta_mm", "phi_rad", "n_n", "v_n", "m_n_mm", "pressure_mpa"):
        scale = np.abs(state[name]).max()
        np.testing.assert_allclose(points[name], state[name], atol=1e-9 * scale)


@pytest.mark.parametrize("load", [1500.0, 5000.0])
def test_nonlinear_spokes_agree_with_solve_bvp(section, independent, load):
    state = lca.solve_law(section, tabulated(), load_n=load)
    shear, radius = section.shear_stiffness_n, section.radius_mm

    def spokes(u):
        return softening(u * radius) * 60 / (2 * np.pi * shear)

    answer = independent.with_law(
        shear / section.axial_stiffness_n,
        shear * radius**2 / section.bending_stiffness_n_mm2,
        spokes,
        load / shear,
        (np.radians(state.theta_c_deg) * 1.05, np.radians(state.theta_t_deg) * 0.97, 0.06),
    )
    assert np.degrees(answer.theta_c) == pytest.approx(state.theta_c_deg, rel=1e-6)
    assert np.degrees(answer.theta_t) == pytest.approx(state.theta_t_deg, rel=1e-6)
    assert answer.sinking * radius == pytest.approx(state.displacement_mm, rel=1e-6)
    assert abs(state.balance_residual) < 1e-12


def test_a_curve_with_corners_agrees_with_solve_bvp(section, independent):
    law = lca.SpokeLaw(
        np.array([-40.0, -20, -10, -4, 0, 2, 5, 9]),
        np.array([-420.0, -290, -190, -90, 0, 55, 170, 290]),
    )
    state = lca.solve_law(section, law, load_n=5000)
    shear, radius = section.shear_stiffness_n, section.radius_mm

    def spokes(u):
        return law.evaluate(u * radius)[0] * 60 / (2 * np.pi * shear)

    answer = independent.with_law(
        shear / section.axial_stiffness_n,
        shear * radius**2 / section.bending_stiffness_n_mm2,
        spokes,
        5000 / shear,
        (0.08, 0.9, 0.06),
        tolerance=1e-8,
    )
    assert answer.sinking * radius == pytest.approx(state.displacement_mm, rel=1e-7)
    assert np.degrees(answer.theta_c) == pytest.approx(state.theta_c_deg, rel=1e-7)


def test_local_contact_spokes_differ_from_the_paper_s_by_little(section, spokes):
    law = lca.SpokeLaw.linear(spokes, 80)
    paper = lca.solve_law(section, law, load_n=5000, contact="paper")
    local = lca.solve_law(section, law, load_n=5000, contact="local")
    # a spoke at the contact's edge is shortened by less than δ
    assert local.contact_force_n < paper.contact_force_n
    assert local.displacement_mm == pytest.approx(paper.displacement_mm, rel=2e-3)
    assert local.displacement_mm > paper.displacement_mm


def test_targets_agree(section):
    law = tabulated(60)
    state = lca.solve_law(section, law, load_n=4000)
    by_sinking = lca.solve_law(section, law, displacement_mm=state.displacement_mm)
    by_angle = lca.solve_law(section, law, theta_c_deg=state.theta_c_deg)
    assert by_sinking.load_n == pytest.approx(4000, rel=1e-9)
    assert by_angle.load_n == pytest.approx(4000, rel=1e-9)


def test_a_spoke_beyond_its_curve_is_refused(section, spokes):
    law = lca.SpokeLaw.linear(spokes, 10)
    with pytest.raises(lca.ModelError, match="compressed by 20.77 mm, their curve ends at 10 mm"):
        lca.solve_law(section, law, load_n=5000)


def test_many_single_spokes_are_the_smeared_ones(section):
    distance = []
    for count in (60, 120):
        spokes = lca.LinearSpokes(30.2 * 60 / count, 13.26 * 60 / count, count)
        law = lca.SpokeLaw.linear(spokes, 60)
        smeared = lca.solve_law(section, law, load_n=1000).displacement_mm
        angles = [0.0, 180 / count]
        singles = [lca.solve_law(section, law, load_n=1000, hub_angle_deg=a) for a in angles]
        assert all(abs(single.balance_residual) < 1e-12 for single in singles)
        distance.append(max(abs(single.displacement_mm - smeared) for single in singles))
    assert distance[0] < 0.01
    assert distance[1] < distance[0] / 4


def test_stiffness_ripples_with_the_hub_and_is_symmetric(section, spokes):
    law = lca.SpokeLaw.linear(spokes, 60)
    ripple = lca.stiffness_ripple(section, law, 1000.0, np.array([2.0, 4.0]))
    stiffness = ripple["stiffness_n_per_mm"].to_numpy()
    assert stiffness[1] == pytest.approx(stiffness[0], rel=1e-9)
    assert ripple["contact_left_deg"][1] == pytest.approx(-ripple["contact_right_deg"][0], rel=1e-7)


def test_edge_pauses_at_a_spoke_while_the_ground_takes_it_over():
    spokes = np.array([0.1, 0.2])
    assert edge_at(0.05, spokes).angle == 0.05
    assert edge_at(0.115, spokes).angle == 0.1
    assert edge_at(0.115, spokes).share == pytest.approx(0.5)
    assert edge_at(0.15, spokes).angle == pytest.approx(0.12)
    assert edge_at(0.15, spokes).share == 0
    assert edge_at(0.30, spokes).angle == pytest.approx(0.24)


def test_single_spokes_have_no_paper_form(section, spokes):
    law = lca.SpokeLaw.linear(spokes, 60)
    with pytest.raises(InputError, match="single spokes act at their local displacement"):
        lca.solve_law(section, law, load_n=5000, hub_angle_deg=0.0, contact="paper")


def rows_of(c10, factor):
    return [
        {"spoke_c10_mpa": c10, "elongation_mm": e, "force_n": factor * f}
        for e, f in ((-30, -400), (0, 0), (5, 150), (-10, -170))
    ]


def test_law_table_interpolates_between_rubbers_and_no_further():
    table = SpokeLawTable.from_rows([*rows_of(2.0, 2.0), *rows_of(1.0, 1.0)], 60)
    assert table.law(1.0).force_n.tolist() == [-400, -170, 0, 150]
    assert table.law(1.5).force_n.tolist() == [-600, -255, 0, 225]
    with pytest.raises(OutOfRangeError, match="from C10 = 1 to 2 MPa"):
        table.law(2.1)
    with pytest.raises(InputError, match="force_n"):
        SpokeLawTable.from_rows([{"spoke_c10_mpa": 1, "elongation_mm": 0}], 60)
