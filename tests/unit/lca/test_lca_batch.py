"""Tables of designs: the same numbers as one by one, and a clear message where there are none."""

import numpy as np
import pytest

from nptcs import lca
from nptcs.errors import InputError
from nptcs.lca.batch import RESULT_COLUMNS, STATUSES, scaled
from nptcs.lca.linear.newton import by_brackets, newton, start_angle
from nptcs.lca.linear.system import Arcs


def test_batch_is_each_design_on_its_own(sweep, design_of_row):
    designs, load = sweep(60, 1)
    batch = lca.solve_batch(designs, load_n=load)
    for row in range(60):
        section, spokes = design_of_row(designs, row)
        if batch.status[row] == "beyond_model":
            with pytest.raises(lca.ModelError):
                lca.solve(section, spokes, load_n=float(load[row]))
            continue
        state = lca.solve(section, spokes, load_n=float(load[row]))
        for name in ("displacement_mm", "theta_c_deg", "theta_t_deg", "contact_force_n"):
            assert batch.columns[name][row] == pytest.approx(getattr(state, name), rel=1e-10)
        assert state.doubts == batch.message[row]


def test_chunks_and_threads_change_nothing(sweep):
    designs, load = sweep(5000, 2)
    one = lca.solve_batch(designs, load_n=load)
    two = lca.solve_batch(designs, load_n=load, workers=2)
    np.testing.assert_array_equal(one.status, two.status)
    for name in RESULT_COLUMNS:
        np.testing.assert_array_equal(one.columns[name], two.columns[name])


def test_order_of_rows_does_not_matter(sweep):
    designs, load = sweep(300, 3)
    order = np.random.default_rng(0).permutation(300)
    straight = lca.solve_batch(designs, load_n=load)
    mixed = lca.solve_batch(
        {name: values[order] for name, values in designs.items()}, load_n=load[order]
    )
    np.testing.assert_array_equal(straight.status[order], mixed.status)
    np.testing.assert_allclose(
        straight.columns["displacement_mm"][order], mixed.columns["displacement_mm"], rtol=1e-11
    )


def test_brackets_find_what_newton_finds(sweep):
    designs, load = sweep(24, 4)
    ring, value = scaled(designs), load / designs["shear_stiffness_n"]
    arcs = Arcs.of(ring)
    quick = newton(ring, arcs, "force", value, start_angle(ring, "force", value))
    contact, transition = by_brackets(ring, arcs, "force", value)
    assert quick.found.sum() > 20
    np.testing.assert_allclose(quick.contact[quick.found], contact[quick.found], rtol=1e-10)
    np.testing.assert_allclose(quick.transition[quick.found], transition[quick.found], rtol=1e-10)


def test_bad_rows_are_marked_and_the_others_are_solved(section, spokes):
    from nptcs.lca.single import design_row

    row = design_row(section, spokes)
    designs = {name: np.full(5, float(value)) for name, value in row.items()}
    designs["tension_n_per_mm"][1] = -1
    designs["radius_mm"][2] = np.nan
    designs["spoke_count"][3] = 59.5
    batch = lca.solve_batch(designs, load_n=[5000, 5000, 5000, 5000, 1e6])
    assert list(batch.status) == ["ok", "bad_input", "bad_input", "bad_input", "beyond_model"]
    assert "tension_n_per_mm" in batch.message[1]
    assert "radius_mm" in batch.message[2]
    assert "spoke_count must be a whole number" in batch.message[3]
    assert "needs a displacement of" in batch.message[4]
    assert batch.columns["displacement_mm"][0] == pytest.approx(20.7413568, rel=1e-8)
    for name in RESULT_COLUMNS:
        assert np.isnan(batch.columns[name][1:]).all()


def test_missing_column_is_named(section, spokes):
    with pytest.raises(InputError, match="radius_mm"):
        lca.solve_batch(
            {"axial_stiffness_n": 1.0, "shear_stiffness_n": 1.0, "bending_stiffness_n_mm2": 1.0},
            load_n=1.0,
        )


def test_sweep_gives_a_right_number_or_a_clear_status(sweep):
    designs, load = sweep(4000, 5)
    batch = lca.solve_batch(designs, load_n=load)
    assert set(batch.status) <= set(STATUSES)
    solved = np.isin(batch.status, ["ok", "doubtful"])
    assert (batch.status == "ok").mean() > 0.9
    assert not (batch.status == "no_convergence").any()
    numbers = {name: values[solved] for name, values in batch.columns.items()}
    assert np.abs(numbers["balance_residual"]).max() < 1e-9
    np.testing.assert_allclose(numbers["load_n"], load[solved], rtol=1e-10)
    assert (numbers["theta_c_deg"] < numbers["theta_t_deg"]).all()
    assert (numbers["tangent_stiffness_n_per_mm"] > 0).all()
    messages = np.array(batch.message, dtype=object)
    assert all(messages[batch.status != "ok"])
    assert not any(messages[batch.status == "ok"])


def test_doubtful_rows_do_break_an_assumption_and_the_others_do_not(sweep, design_of_row):
    designs, load = sweep(1500, 6)
    batch = lca.solve_batch(designs, load_n=load)
    doubtful = np.flatnonzero(batch.status == "doubtful")[:10]
    fine = np.flatnonzero(batch.status == "ok")[:30]
    assert len(doubtful) == 10
    for row in [*doubtful, *fine]:
        state = lca.solve(*design_of_row(designs, row), load_n=float(load[row]))
        near = state.at(np.linspace(state.theta_c_deg, state.theta_t_deg, 300))["u_r_mm"]
        far = state.at(np.linspace(state.theta_t_deg + 1e-6, 180, 3000))["u_r_mm"]
        pulls = near.max() > 1e-8 * state.displacement_mm
        pushes = far.min() < -1e-8 * state.displacement_mm
        assert (pulls or pushes) == (row in doubtful)


def test_near_double_roots_lose_no_digits(section):
    # a²/4 = a + c: the two exponentials of the tension arc fall together
    epsilon = section.shear_stiffness_n / section.axial_stiffness_n
    kappa2 = section.shear_stiffness_n * section.radius_mm**2 / section.bending_stiffness_n_mm2
    double = 4 * (1 + epsilon + kappa2)
    unit = section.shear_stiffness_n / section.radius_mm**2
    factors = 1 + np.array([-1e-3, -1e-7, -1e-11, 0.0, 1e-11, 1e-7, 1e-3])
    stiffness = []
    for factor in factors:
        spokes = lca.LinearSpokes.from_foundation(double * factor * unit, 1.0, section.radius_mm)
        state = lca.solve(section, spokes, load_n=5000)
        stiffness.append(state.stiffness_n_per_mm)
        assert abs(state.balance_residual) < 1e-9
    # smooth through the double root: the slope between neighbours is that of the wide interval
    slope = (stiffness[-1] - stiffness[0]) / 2e-3
    predicted = stiffness[3] + slope * (factors - 1)
    np.testing.assert_allclose(stiffness[1:-1], predicted[1:-1], rtol=1e-9)
