"""Loaded rings: balance, symmetry, refinement, the finite elements, the table's range."""

import numpy as np
import pytest

from nptcs.config.solvers.fe import FeModel, GroundContact, TyreMesh
from nptcs.config.solvers.ring import RingElements, RingOptions
from nptcs.config.solvers.tyre import TyreGeometry
from nptcs.fe.tyre.equilibrium import TyreModel
from nptcs.ring.gradient import stiffness_gradient
from nptcs.ring.kernel.compiled import HAS_NUMBA
from nptcs.ring.responses import contact_cells
from nptcs.ring.solution import SpokeRangeError, press_through_loads, tangent_stiffness
from nptcs.ring.tyre import ring_tyre

TYRE = TyreGeometry()
LOADS = [800.0, 1600.0, 2400.0]
SOFT_GROUND = GroundContact(penalty_mpa_per_mm=50.0, smoothing_mm=0.1)


def built(table, c10=5.0, kernel="numpy", tyre=TYRE, **options):
    return ring_tyre(tyre, table, c10, RingOptions(**options), kernel=kernel)


@pytest.fixture(scope="module")
def loaded(table):
    tyre = built(table)
    return tyre, press_through_loads(tyre, LOADS)


def test_spokes_carry_the_load(table, loaded):
    tyre, states = loaded
    assert [state.force_n for state in states][-3:] == LOADS
    for state in states:
        motion = tyre.spoke_motion(state.u)
        _, force, _ = table.evaluate(motion)
        angle = tyre.nodes.theta[tyre.nodes.feet]
        # forces on the feet, outward and along θ, summed along the vertical
        lift = np.sum(-force[:, 0] * np.cos(angle) + force[:, 1] * np.sin(angle))
        assert lift == pytest.approx(state.force_n, rel=1e-6)


def test_the_ground_carries_the_load(loaded):
    tyre, states = loaded
    _, pressure, shear = tyre.traction(states[-1].u, states[-1].rise_mm, states[-1].anchor_before)
    assert np.sum(pressure * tyre.areas_mm2()) == pytest.approx(LOADS[-1], rel=1e-6)
    assert np.all(np.abs(shear) <= 0.3 * pressure + 1e-8)
    assert np.abs(shear).max() > 0.01 * pressure.max()


def test_a_mirrored_tyre_stays_mirrored(even_table):
    tyre = built(even_table)
    outward, along = tyre.neutral_line(press_through_loads(tyre, LOADS)[-1].u)
    mirrored = np.argsort(np.mod(-tyre.nodes.theta + 1e-9, 2 * np.pi))
    order = np.argsort(np.mod(tyre.nodes.theta + 1e-9, 2 * np.pi))
    np.testing.assert_allclose(outward[order], outward[mirrored], atol=1e-7)
    np.testing.assert_allclose(along[order], -along[mirrored], atol=1e-7)


def test_the_leaning_spoke_turns_the_ring(loaded):
    tyre, states = loaded
    _, along = tyre.neutral_line(states[-1].u)
    assert abs(np.mean(along)) > 1e-3


def test_refinement_changes_little(table, loaded):
    fine = built(table, mesh=RingElements(elements_per_pitch=6, refined_deg=20))
    rises = [press_through_loads(tyre, LOADS)[-1].rise_mm for tyre in (built(table), fine)]
    assert rises[0] == pytest.approx(rises[1], rel=0.003)


def test_the_ring_turned_by_half_a_pitch(table):
    """Which spoke meets the ground matters by less than a tenth."""
    one, other = (
        press_through_loads(built(table, mesh=RingElements(first_spoke_deg=angle)), LOADS)[
            -1
        ].rise_mm
        for angle in (0.0, 3.0)
    )
    assert one == pytest.approx(other, rel=0.1)


def test_tangent_stiffness_is_the_slope_of_the_curve(table):
    tyre = built(table, contact=GroundContact(friction=0.0))
    below, here, above = press_through_loads(tyre, [1590.0, 1600.0, 1610.0])[-3:]
    slope = 20.0 / (above.rise_mm - below.rise_mm)
    assert tangent_stiffness(tyre, here) == pytest.approx(slope, rel=2e-3)


def test_work_is_stored_without_friction(table):
    """∫ F dδ is the energy of band and spokes, but for what the ground's penalty keeps."""
    stiff = GroundContact(friction=0.0, penalty_mpa_per_mm=500.0, smoothing_mm=0.002)
    tyre = built(table, contact=stiff, axial="plane_strain")
    loads = np.linspace(0.0, 2400.0, 49)[1:]
    states = press_through_loads(tyre, loads.tolist())
    rise = [0.0, *(state.rise_mm for state in states)]
    force = [0.0, *(state.force_n for state in states)]
    work = np.trapezoid(force, rise)
    assert sum(tyre.energy(states[-1].u).values()) == pytest.approx(work, rel=3e-3)


@pytest.mark.parametrize("axial", ["free_edges", "plane_strain"])
def test_it_equals_the_finite_elements(table, axial):
    tyre = built(table, contact=SOFT_GROUND, axial=axial)
    states = press_through_loads(tyre, LOADS)
    fe = FeModel(
        axial=axial, contact=SOFT_GROUND, tyre_mesh=TyreMesh(foot_elements=1, gap_elements=2)
    )
    finite = TyreModel(
        TYRE,
        table,
        fe.geometry.foot_width_mm(),
        5.0,
        fe.band_bulk_to_shear(),
        fe.tyre_mesh,
        fe.contact,
    )
    reached = finite.load(LOADS)
    rise = dict(zip(reached.path.force_n, reached.path.rise_mm, strict=True))
    for state in states[-3:]:
        assert state.rise_mm == pytest.approx(rise[state.force_n], rel=0.007)
    _, pressure = finite.ground.pressure_profile(reached.displacement, reached.rise_mm)
    own = contact_cells(tyre, states[-1]).pressure_mpa
    assert own.max() == pytest.approx(pressure.max(), rel=0.08)
    np.testing.assert_allclose(tyre.spoke_motion(states[-1].u), reached.motion, atol=0.12)


def test_the_parts_of_the_tread_in_contact_carry_the_load(table):
    tyre = built(table)
    cells = contact_cells(tyre, press_through_loads(tyre, [1500.0, 3000.0])[-1])
    carried = np.sum(cells.pressure_mpa * cells.length_mm) * TYRE.tread_width_mm
    assert carried == pytest.approx(3000.0, rel=1e-6)


def test_a_spoke_that_leaves_its_table_ends_the_path(table):
    with pytest.raises(SpokeRangeError, match="outside the table's range") as caught:
        press_through_loads(built(table), [2000.0, 90000.0])
    assert caught.value.states[-1].force_n > 2000.0


@pytest.mark.parametrize("loads", [[], [100.0, 50.0], [0.0], [float("nan")]])
def test_loads_that_do_not_rise_are_refused(table, loads):
    with pytest.raises(ValueError, match="rise"):
        press_through_loads(built(table), loads)


def test_spokes_that_do_not_fit_the_tyre_are_refused(table):
    with pytest.raises(ValueError, match="distance between rim and band"):
        built(table, tyre=TyreGeometry(rim_diameter_mm=420.0))


@pytest.mark.skipif(not HAS_NUMBA, reason="needs numba")
def test_the_compiled_kernel_gives_the_same_curve(table, loaded):
    compiled = press_through_loads(built(table, kernel="numba"), LOADS)
    for one, other in zip(loaded[1], compiled, strict=True):
        assert one.rise_mm == pytest.approx(other.rise_mm, rel=1e-8)


def test_the_adjoint_is_the_derivative_of_the_whole_path(table):
    def build(values):
        band, spokes, outer, tread, wire = values
        dimensions = TYRE.model_copy(
            update={"outer_diameter_mm": outer, "outer_wire_diameter_mm": wire}
        )
        options = RingOptions(contact=SOFT_GROUND)
        return ring_tyre(dimensions, table, band, options, tread, spokes, kernel="numpy")

    start = np.array([5.0, 1.0, 646.8, 4.0, 626.5])
    found = stiffness_gradient(build, start, LOADS)
    assert found.stiffness_n_per_mm == pytest.approx(LOADS[-1] / found.displacement_mm)
    for place, step in enumerate((1e-3, 1e-3, 1e-3, 1e-3, 1e-3)):
        ends = []
        for sign in (1, -1):
            moved = start.copy()
            moved[place] += sign * step
            ends.append(LOADS[-1] / press_through_loads(build(moved), LOADS)[-1].rise_mm)
        slope = (ends[0] - ends[1]) / (2 * step)
        assert found.stiffness_slope[place] == pytest.approx(slope, rel=1e-3)
