"""Against other methods: ``solve_bvp`` on a few designs, collocation on many."""

import numpy as np
import pytest

from nptcs import lca
from nptcs.lca.any_spokes.with_law import solve_law
from nptcs.lca.batch import scaled


def solved(sweep, rows, seed):
    """Designs of the robustness sweep with their results, those with numbers only."""
    designs, load = sweep(rows, seed)
    batch = lca.solve_batch(designs, load_n=load)
    return designs, batch, np.flatnonzero(np.isin(batch.status, ["ok", "doubtful"]))


def test_agrees_with_solve_bvp_over_the_sweep(sweep, independent):
    designs, batch, rows = solved(sweep, 40, 11)
    ring = scaled(designs)
    compared = 0
    for row in rows[batch.status[rows] == "ok"][:12]:
        values = {name: batch.columns[name][row] for name in batch.columns}
        radius, shear = designs["radius_mm"][row], designs["shear_stiffness_n"][row]
        guess = (
            np.radians(values["theta_c_deg"]) * 1.03,
            np.radians(values["theta_t_deg"]) * 0.98,
            values["displacement_mm"] / radius * 1.05,
        )
        answer = independent.linear(
            ring.epsilon[row],
            ring.kappa2[row],
            ring.compression[row],
            ring.tension[row],
            values["load_n"] / shear,
            guess,
            points=41,
        )
        assert np.degrees(answer.theta_c) == pytest.approx(values["theta_c_deg"], rel=1e-6)
        assert np.degrees(answer.theta_t) == pytest.approx(values["theta_t_deg"], rel=1e-6)
        assert answer.sinking * radius == pytest.approx(values["displacement_mm"], rel=1e-6)
        compared += 1
    assert compared == 12


def test_agrees_with_collocation_on_two_hundred_designs(sweep, design_of_row):
    designs, batch, rows = solved(sweep, 230, 12)
    rows = rows[batch.status[rows] == "ok"][:200]
    assert len(rows) == 200
    worst = 0.0
    for row in rows:
        section, spokes = design_of_row(designs, row)
        law = lca.SpokeLaw.linear(spokes, section.radius_mm)
        state = solve_law(
            section, law, theta_c_deg=float(batch.columns["theta_c_deg"][row]), contact="paper"
        )
        for ours, other in (
            (batch.columns["load_n"][row], state.load_n),
            (batch.columns["displacement_mm"][row], state.displacement_mm),
            (batch.columns["theta_t_deg"][row], state.theta_t_deg),
        ):
            worst = max(worst, abs(other / ours - 1))
    assert worst < 1e-7
