"""The load-bearing model behind the contract of all solvers."""

import numpy as np
import pandas as pd
import pytest

from nptcs.config.solvers.tyre import TyreGeometry
from nptcs.errors import InputError
from nptcs.solvers.contract import CaseInputs, Status
from nptcs.solvers.lca import SOLVER, LcaOptions

TABLE_10 = [
    {"spoke_c10_mpa": c, "tension_stiffness_n_per_mm": t, "compression_stiffness_n_per_mm": j}
    for c, t, j in ((1, 30.2, 13.26), (2, 58.4, 25.36), (3, 84.7, 36.38))
]


def inputs(spoke_c10_mpa=1.0, load_n=5000.0, rows=TABLE_10, **options):
    chosen = LcaOptions(**options)
    (key,) = chosen.tables()
    return CaseInputs(
        "rubber_11",
        {"shear_band_c10_mpa": 5.0, "spoke_c10_mpa": spoke_c10_mpa},
        load_n,
        TyreGeometry(),
        chosen,
        tables={key: rows},
    )


def test_case_of_table_11():
    result = SOLVER.solve(inputs())
    assert result.status is Status.OK
    assert result.message == ""
    assert result.displacement_mm == pytest.approx(20.7413568, rel=1e-8)
    assert result.vertical_stiffness_n_per_mm == pytest.approx(241.064268, rel=1e-8)
    assert result.extra["theta_c_deg"] == pytest.approx(4.569081, abs=1e-6)
    assert result.extra["contact_force_n"] + result.extra["ring_force_n"] == pytest.approx(5000)
    assert abs(result.extra["balance_residual"]) < 1e-12
    curve = pd.DataFrame(result.curve)
    assert len(curve) == 21
    assert curve["displacement_mm"].iloc[0] == 0
    assert curve["displacement_mm"].iloc[-1] == pytest.approx(result.displacement_mm, rel=1e-12)
    assert curve["displacement_mm"].is_monotonic_increasing


def test_the_neutral_line_is_flat_on_the_ground_and_the_same_on_both_sides():
    result = SOLVER.solve(inputs())
    line = pd.DataFrame(result.neutral_line)
    assert list(line["theta_deg"]) == list(range(-180, 181))
    theta = np.radians(line["theta_deg"])
    radius = TyreGeometry().band_radius_mm
    depth = (radius + line["radial_mm"]) * np.cos(theta) - line["tangential_mm"] * np.sin(theta)
    on_ground = line["theta_deg"].abs() < result.extra["theta_c_deg"]
    np.testing.assert_allclose(depth[on_ground], radius - result.displacement_mm, atol=1e-4)
    assert (depth[~on_ground] < radius - result.displacement_mm).all()
    np.testing.assert_allclose(line["radial_mm"], line["radial_mm"][::-1], atol=1e-4)
    np.testing.assert_allclose(line["tangential_mm"], -line["tangential_mm"][::-1], atol=1e-4)


def test_a_spoke_law_gives_the_whole_neutral_line_as_well():
    result = SOLVER.solve(inputs(contact_spokes="local"))
    line = pd.DataFrame(result.neutral_line).set_index("theta_deg")
    assert len(line) == 361
    assert line["radial_mm"][0.0] == pytest.approx(-result.displacement_mm, abs=0.02)
    np.testing.assert_allclose(line["radial_mm"], line["radial_mm"][::-1], atol=1e-4)
    np.testing.assert_allclose(line["tangential_mm"], -line["tangential_mm"][::-1], atol=1e-4)
    # away from the contact close to the model of two stiffnesses
    linear = pd.DataFrame(SOLVER.solve(inputs()).neutral_line).set_index("theta_deg")
    for column in ("radial_mm", "tangential_mm"):
        far = linear[column][90.0], line[column][90.0]
        assert far[1] == pytest.approx(far[0], rel=0.1)


def test_printed_section_is_an_option():
    result = SOLVER.solve(inputs(section="printed"))
    assert result.displacement_mm == pytest.approx(19.497276, rel=1e-6)


def test_stiffness_is_interpolated_in_c10_and_grows_with_it():
    stiffness = [SOLVER.solve(inputs(c)).vertical_stiffness_n_per_mm for c in (1.0, 1.5, 2.0, 2.9)]
    assert stiffness == sorted(stiffness)
    # the table gives its own values at its own rows
    assert stiffness[2] == pytest.approx(350.198760, rel=1e-8)


@pytest.mark.parametrize("c10", [0.99, 3.01])
def test_rubber_outside_the_table_is_an_error_with_a_reason(c10):
    result = SOLVER.solve(inputs(c10))
    assert result.status is Status.ERROR
    assert "reaches from C10 = 1 to 3 MPa" in result.message
    assert "not extrapolated" in result.message
    assert result.vertical_stiffness_n_per_mm is None


def test_load_beyond_the_wheel_is_an_error_with_a_reason():
    result = SOLVER.solve(inputs(load_n=50000.0))
    assert result.status is Status.ERROR
    assert "more than the 87.97 mm that the wheel allows" in result.message


@pytest.mark.parametrize(
    ("rows", "text"),
    [
        (TABLE_10[:1], "needs at least two rows"),
        ([*TABLE_10, TABLE_10[0]], "a C10 is given twice"),
        ([TABLE_10[0], {"spoke_c10_mpa": 2}], "tension_stiffness_n_per_mm"),
        ([TABLE_10[0], TABLE_10[1] | {"compression_stiffness_n_per_mm": -1}], "above zero"),
    ],
)
def test_bad_spoke_tables_are_refused_by_name(rows, text):
    with pytest.raises(InputError, match=text) as refusal:
        SOLVER.solve(inputs(rows=rows, spoke_stiffness_table="spokes.csv"))
    assert "spokes.csv" in str(refusal.value)


def test_local_contact_spokes_are_an_option():
    result = SOLVER.solve(inputs(contact_spokes="local", curve_points=2))
    assert result.displacement_mm == pytest.approx(20.770622, rel=1e-6)


def test_spoke_curves_replace_the_stiffness():
    rows = [
        {"spoke_c10_mpa": 1.0, "elongation_mm": e, "force_n": (30.2 if e > 0 else 13.26) * e}
        for e in (-60, 0, 20)
    ]
    straight = SOLVER.solve(inputs(rows=rows, spoke_law_table="curves.csv", curve_points=2))
    assert straight.displacement_mm == pytest.approx(20.7413568, rel=1e-8)
    soft = [row | {"force_n": 0.8 * row["force_n"]} for row in rows]
    softer = SOLVER.solve(inputs(rows=soft, spoke_law_table="curves.csv", curve_points=2))
    assert softer.displacement_mm > straight.displacement_mm
    short = [row for row in rows if row["elongation_mm"] != -60]
    short.append({"spoke_c10_mpa": 1.0, "elongation_mm": -15, "force_n": -198.9})
    refused = SOLVER.solve(inputs(rows=short, spoke_law_table="curves.csv", curve_points=2))
    assert refused.status is Status.ERROR
    assert "their curve ends at 15 mm" in refused.message


def test_factors_are_the_two_rubbers_only():
    assert SOLVER.factors == {"shear_band_c10_mpa", "spoke_c10_mpa"}
    assert SOLVER.required == SOLVER.factors
