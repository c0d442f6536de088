"""The exact linear model: its equations, its limits, its symmetries."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import quad

from nptcs import lca
from nptcs.errors import InputError

STATE = ["u_r_mm", "u_theta_mm", "phi_rad", "n_n", "v_n", "m_n_mm"]


def assert_fields_equal(a, b, section):
    """Compare states on the scale of each quantity."""
    scale = np.array(
        [section.radius_mm] * 2
        + [1]
        + [section.shear_stiffness_n] * 2
        + [section.shear_stiffness_n * section.radius_mm]
    )
    difference = (a[STATE].to_numpy() - b[STATE].to_numpy()) / scale
    assert np.abs(difference).max() < 1e-10


def test_state_is_continuous_at_both_angles(section, spokes):
    state = lca.solve(section, spokes, load_n=5000)
    for angle in (state.theta_c_deg, state.theta_t_deg):
        gap = 1e-9 * np.array([-1, 1])
        before, after = (state.at(angle + shift) for shift in gap)
        assert before["region"].iloc[0] != after["region"].iloc[0]
        assert_fields_equal(before, after, section)


def test_contact_is_flat_and_spokes_change_sign_at_the_transition(section, spokes):
    state = lca.solve(section, spokes, load_n=5000)
    contact = state.at(np.linspace(-state.theta_c_deg, state.theta_c_deg, 41))
    theta = np.radians(contact["theta_deg"])
    height = (section.radius_mm + contact["u_r_mm"]) * np.cos(theta) - contact[
        "u_theta_mm"
    ] * np.sin(theta)
    np.testing.assert_allclose(height, section.radius_mm - state.displacement_mm, atol=1e-10)
    assert state.at(state.theta_t_deg)["u_r_mm"].iloc[0] == pytest.approx(0, abs=1e-9)
    assert (state.at(np.linspace(5, 56, 50))["u_r_mm"] < 0).all()
    assert (state.at(np.linspace(57, 180, 50))["u_r_mm"] > 0).all()


@pytest.mark.parametrize("region", ["contact", "compression", "tension"])
def test_fields_fulfil_the_ring_s_equations(section, spokes, region):
    state = lca.solve(section, spokes, load_n=12000)
    c, t = state.theta_c_deg, state.theta_t_deg
    low, high = {"contact": (0, c), "compression": (c, t), "tension": (t, 180)}[region]
    centre, half = np.radians((low + high) / 2), np.radians((high - low) / 2)
    nodes = np.polynomial.chebyshev.chebpts1(24)
    theta = centre + half * nodes
    table = state.at(np.degrees(theta))
    u, v, phi, n, shear, m = (table[name].to_numpy() for name in STATE)

    def slope(values):
        coefficients = np.polynomial.chebyshev.chebfit(nodes, values, 23)
        derivative = np.polynomial.chebyshev.chebder(coefficients)
        return np.polynomial.chebyshev.chebval(nodes, derivative) / half

    k, j = spokes.foundation(section.radius_mm)
    radius, ea = section.radius_mm, section.axial_stiffness_n
    ga, ei = section.shear_stiffness_n, section.bending_stiffness_n_mm2
    pressure = section.width_mm * table["pressure_mpa"].to_numpy()
    stiffness = {"contact": 0.0, "compression": j, "tension": k}[region]
    p_r = -pressure * np.cos(theta) - stiffness * u
    p_theta = pressure * np.sin(theta)
    np.testing.assert_allclose(n, ea / radius * (slope(v) + u), atol=1e-7 * ga)
    np.testing.assert_allclose(shear, ga / radius * (slope(u) - v + radius * phi), atol=1e-9 * ga)
    np.testing.assert_allclose(m, ei / radius * slope(phi), atol=1e-9 * ga * radius)
    np.testing.assert_allclose(slope(n) + shear, -radius * p_theta, atol=1e-9 * ga)
    np.testing.assert_allclose(slope(shear) - n, -radius * p_r, atol=1e-9 * ga)
    np.testing.assert_allclose(slope(m), radius * shear, atol=1e-9 * ga * radius)


def test_forces_are_the_integrals_of_the_equations_13_and_14(section, spokes):
    state = lca.solve(section, spokes, load_n=5000)
    edge = np.radians(state.theta_c_deg)

    def ground(theta):
        pressure = state.at(np.degrees(theta))["pressure_mpa"].iloc[0]
        return 2 * section.radius_mm * section.width_mm * pressure

    assert state.ring_force_n == pytest.approx(quad(ground, 0, edge)[0], rel=1e-9)
    _, j = spokes.foundation(section.radius_mm)
    expected = 2 * section.radius_mm * j * state.displacement_mm * edge
    assert state.contact_force_n == pytest.approx(expected, rel=1e-12)
    assert state.load_n == pytest.approx(5000, rel=1e-12)
    assert abs(state.balance_residual) < 1e-12


def test_three_targets_lead_to_the_same_state(section, spokes):
    state = lca.solve(section, spokes, load_n=4321)
    for other in (
        lca.solve(section, spokes, displacement_mm=state.displacement_mm),
        lca.solve(section, spokes, theta_c_deg=state.theta_c_deg),
    ):
        assert other.load_n == pytest.approx(4321, rel=1e-10)
        assert other.theta_t_deg == pytest.approx(state.theta_t_deg, rel=1e-10)


def test_tangent_stiffness_is_the_slope_of_the_curve(section, spokes):
    state = lca.solve(section, spokes, load_n=5000)
    curve = lca.curve(section, spokes, load_n=[4999, 5001])
    slope = 2 / np.diff(curve["displacement_mm"])[0]
    assert state.tangent_stiffness_n_per_mm == pytest.approx(slope, rel=1e-6)


def test_rigid_ring_moves_as_a_whole(section, spokes):
    rigid = replace(
        section, axial_stiffness_n=1e14, shear_stiffness_n=1e12, bending_stiffness_n_mm2=1e17
    )
    state = lca.solve(rigid, spokes, load_n=5000)
    k, j = spokes.foundation(section.radius_mm)
    # F = ∫ spoke forces with u = -δ cos θ over the half in tension and that in compression
    assert state.stiffness_n_per_mm == pytest.approx(
        np.pi * section.radius_mm * (j + k) / 2, rel=1e-5
    )
    assert state.theta_t_deg == pytest.approx(90, abs=1e-3)


def test_small_load_on_equal_spokes_is_the_fourier_series_of_a_point_load(section):
    spokes = lca.LinearSpokes(20.0, 20.0)
    state = lca.solve(section, spokes, load_n=0.01)
    epsilon = section.shear_stiffness_n / section.axial_stiffness_n
    kappa2 = section.shear_stiffness_n * section.radius_mm**2 / section.bending_stiffness_n_mm2
    k, _ = spokes.foundation(section.radius_mm)
    a = section.radius_mm**2 * k / section.shear_stiffness_n
    n = np.arange(1, 200_001, dtype=float)
    one = np.ones_like(n)
    # N' = -V, V' = N + a u + F, M' = V for u, v, Φ = u_n cos nθ, v_n sin nθ, φ_n sin nθ
    matrix = np.array(
        [
            [-n / epsilon - n, -n * n / epsilon - one, one],
            [-n * n - 1 / epsilon - a, -n - n / epsilon, n],
            [-n, -one, one + n * n / kappa2],
        ]
    ).transpose(2, 0, 1)
    right = np.array([0, 1 / np.pi, 0])
    waves = np.linalg.solve(matrix, np.broadcast_to(right, (len(n), 3))[..., None])[:, 0, 0]
    compliance = 1 / (2 * np.pi) / (1 / epsilon + a) - waves.sum()
    expected = section.shear_stiffness_n / section.radius_mm / compliance
    assert state.stiffness_n_per_mm == pytest.approx(expected, rel=1e-5)


@settings(max_examples=25, deadline=None)
@given(
    factor=st.floats(1e-3, 1e3),
    length=st.floats(0.1, 10),
    load=st.floats(200, 12000),
)
def test_scaling_laws(factor, length, load):
    section = lca.ShearBandSection(2.7e7, 30100, 1.05e9, 300, 215)
    spokes = lca.LinearSpokes(60, 25)
    state = lca.solve(section, spokes, load_n=load)
    # all moduli and the load times a factor: the same shape
    stiffer = lca.solve(
        lca.ShearBandSection(2.7e7 * factor, 30100 * factor, 1.05e9 * factor, 300, 215),
        lca.LinearSpokes(60 * factor, 25 * factor),
        load_n=load * factor,
    )
    assert stiffer.theta_c_deg == pytest.approx(state.theta_c_deg, rel=1e-9)
    assert stiffer.displacement_mm == pytest.approx(state.displacement_mm, rel=1e-9)
    # all lengths times a factor at the same moduli: forces grow with its square
    area = length**2
    larger = lca.solve(
        lca.ShearBandSection(
            2.7e7 * area, 30100 * area, 1.05e9 * area**2, 300 * length, 215 * length
        ),
        lca.LinearSpokes(60 * length, 25 * length),
        load_n=load * area,
    )
    assert larger.theta_t_deg == pytest.approx(state.theta_t_deg, rel=1e-9)
    assert larger.displacement_mm == pytest.approx(state.displacement_mm * length, rel=1e-9)
    assert larger.mean_pressure_mpa == pytest.approx(state.mean_pressure_mpa, rel=1e-9)


def test_state_is_symmetric_about_the_vertical(section, spokes):
    state = lca.solve(section, spokes, load_n=5000)
    angles = np.linspace(0.1, 179.9, 60)
    right, left, around = state.at(angles), state.at(-angles), state.at(360 - angles)
    mirrored = left.copy()
    mirrored[["u_theta_mm", "phi_rad", "v_n"]] *= -1
    assert_fields_equal(right, mirrored, section)
    assert_fields_equal(left, around, section)


def test_displacement_contact_and_pressure_grow_with_the_load(section, spokes):
    curve = lca.curve(section, spokes, load_n=np.geomspace(1, 20000, 80))
    assert (curve["status"] == "ok").all()
    for name in ("displacement_mm", "theta_c_deg", "contact_length_mm", "mean_pressure_mpa"):
        assert (np.diff(curve[name]) > 0).all()


@pytest.mark.parametrize(
    ("target", "text"),
    [
        ({"load_n": -5.0}, "load_n must be a finite number above zero, got -5"),
        ({"load_n": float("nan")}, "load_n must be a finite number above zero, got nothing"),
        ({"theta_c_deg": 88.0}, "theta_c_deg must be below 85"),
        ({}, "exactly one of load_n"),
        ({"load_n": 1.0, "displacement_mm": 1.0}, "exactly one of load_n"),
    ],
)
def test_senseless_targets_are_refused(section, spokes, target, text):
    with pytest.raises(InputError, match=text):
        lca.solve(section, spokes, **target)


def test_load_beyond_the_wheel_is_refused_with_the_displacement_it_needs(section, spokes):
    with pytest.raises(lca.ModelError, match=r"151\.4 mm, more than the 88 mm"):
        lca.solve(section, spokes, load_n=50000, largest_displacement_mm=88)


@pytest.mark.parametrize("name", ["tension_n_per_mm", "compression_n_per_mm"])
@pytest.mark.parametrize("value", [0.0, -3.0, float("inf")])
def test_negative_stiffness_is_refused_by_name(name, value):
    values = {"tension_n_per_mm": 30.0, "compression_n_per_mm": 13.0} | {name: value}
    with pytest.raises(InputError, match=name):
        lca.LinearSpokes(**values)


def test_section_constants_are_checked(section):
    with pytest.raises(InputError, match="bending_stiffness_n_mm2"):
        replace(section, bending_stiffness_n_mm2=-1.0)


def test_foundation_and_spokes_are_equation_4(spokes, section):
    k, j = spokes.foundation(section.radius_mm)
    assert (round(k, 2), round(j, 2)) == (0.95, 0.42)
    back = lca.LinearSpokes.from_foundation(k, j, section.radius_mm)
    assert back.tension_n_per_mm == pytest.approx(30.2)
    assert back.compression_n_per_mm == pytest.approx(13.26)
