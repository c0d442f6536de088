"""Energies, residuals and tangents of the ring; both kernels; the cyclic solution."""

import numpy as np
import pytest

from nptcs.config.solvers.fe import GroundContact
from nptcs.config.solvers.ring import RingElements, RingOptions
from nptcs.config.solvers.tyre import TyreGeometry
from nptcs.ring.kernel import numpy_kernel
from nptcs.ring.kernel.compiled import HAS_NUMBA
from nptcs.ring.kernel.cyclic_elimination import eliminate
from nptcs.ring.kernel.elementwise import band, ground, places
from nptcs.ring.kernel.system import NO_FEET
from nptcs.ring.tyre import ring_tyre

COARSE = RingOptions(
    mesh=RingElements(elements_per_pitch=1, refined_deg=7, refinement=2),
    contact=GroundContact(penalty_mpa_per_mm=50.0, smoothing_mm=0.1),
)
RISE = 4.0


@pytest.fixture(scope="module")
def tyre(table):
    return ring_tyre(TyreGeometry(), table, 5.0, COARSE, kernel="numpy")


@pytest.fixture(scope="module")
def state(tyre):
    """Unknowns that follow no pattern, and anchors away from the surface."""
    random = np.random.default_rng(3)
    u = random.normal(size=(len(tyre.nodes.theta), 5)) * [0.5, 0.5, 0.01, 0.01, 0.2]
    return u, tyre.surface(np.zeros_like(u))[0] + 0.05


def dense(system):
    count = len(system.diagonal)
    matrix = np.zeros((5 * count, 5 * count))
    for i in range(count):
        here, after = slice(5 * i, 5 * i + 5), np.arange(5) + 5 * ((i + 1) % count)
        matrix[here, here] += system.diagonal[i]
        matrix[here, after] += system.upper[i]
        matrix[after, here] += system.lower[i]
    return matrix


def difference(function, u, step):
    """Central differences of a function of the unknowns, last axis as they are numbered."""
    columns = []
    for place in range(u.size):
        move = np.zeros(u.size)
        move[place] = step
        move = move.reshape(u.shape)
        columns.append((function(u + move) - function(u - move)) / (2 * step))
    return np.stack(columns, axis=-1)


def test_residual_is_the_derivative_of_the_energy(tyre, state):
    u, anchor = state
    lifted = numpy_kernel.assemble(tyre.ring, u, -50.0, anchor)
    assert lifted.reaction_n == 0.0
    slopes = difference(lambda v: sum(tyre.energy(v).values()), u, 1e-5)
    np.testing.assert_allclose(lifted.force.ravel(), slopes, atol=1e-7 * np.abs(slopes).max())


def test_tangent_is_the_derivative_of_the_residual_with_ground_and_friction(tyre, state):
    u, anchor = state
    system = numpy_kernel.assemble(tyre.ring, u, RISE, anchor)
    assert system.reaction_n > 1e4
    slopes = difference(
        lambda v: numpy_kernel.assemble(tyre.ring, v, RISE, anchor).force.ravel(), u, 1e-6
    )
    scale = np.abs(slopes).max(axis=1, keepdims=True)
    assert (np.abs(dense(system) - slopes) / scale).max() < 1e-6


def test_ground_derivatives_by_rise_and_unknowns(tyre, state):
    u, anchor = state
    system = numpy_kernel.assemble(tyre.ring, u, RISE, anchor)
    up, down = (numpy_kernel.assemble(tyre.ring, u, RISE + h, anchor) for h in (1e-6, -1e-6))
    scale = np.abs(system.slope).max()
    np.testing.assert_allclose(system.slope, (up.force - down.force) / 2e-6, atol=1e-6 * scale)
    slope = (up.reaction_n - down.reaction_n) / 2e-6
    assert system.reaction_slope == pytest.approx(slope, rel=1e-6)
    row = difference(
        lambda v: numpy_kernel.assemble(tyre.ring, v, RISE, anchor).reaction_n, u, 1e-6
    )
    np.testing.assert_allclose(system.row.ravel(), row, atol=1e-6 * np.abs(row).max())


@pytest.mark.parametrize("kernel", ["numpy", "numba"])
def test_what_is_lifted_between_two_contacts_feels_no_ground(table, kernel):
    if kernel == "numba" and not HAS_NUMBA:
        pytest.skip("needs numba")
    tyre = ring_tyre(TyreGeometry(), table, 5.0, COARSE, kernel=kernel)
    u = np.zeros((len(tyre.nodes.theta), 5))
    lifted = np.abs(np.degrees(tyre.nodes.theta)) < 4
    u[lifted, 1] = 20.0
    # without slip the ground's shear would be stiffest
    anchor = tyre.surface(u)[0]
    system = tyre.kernel.assemble(tyre.ring, u, 6.0, anchor)
    above = tyre.kernel.assemble(tyre.ring, u, -50.0, anchor)
    moved = np.abs(system.diagonal - above.diagonal).max(axis=(1, 2))
    first, last = np.flatnonzero(lifted)[[0, -1]]
    assert moved[first - 1] > 1.0
    assert moved[last + 1] > 1.0
    np.testing.assert_array_equal(moved[lifted], 0.0)


@pytest.mark.parametrize("turn", [0.0, 0.4, -1.3])
def test_rigid_motion_costs_nothing(tyre, turn):
    place = tyre.nodes.positions(tyre.section.radius_mm)
    rotation = np.array([[np.cos(turn), -np.sin(turn)], [np.sin(turn), np.cos(turn)]])
    u = np.zeros((len(place), 5))
    u[:, :2] = place @ rotation.T - place + [3.0, -7.0]
    # θ and ψ turn t towards the outside, which is clockwise
    u[:, 2:4] = -turn
    assert abs(tyre.energy(u)["band"]) < 1e-12
    bent = u.copy()
    bent[0, 0] += 0.1
    assert tyre.energy(bent)["band"] > 1.0


def test_the_core_shears_with_the_wires_axes_not_their_sections(tyre):
    """All slopes w' with ψ = θ = 0: the core shears by w' as the wires do."""
    own = tyre.ring.stiffness
    length, slope, zero = 5.0, 1e-3, np.zeros(5)
    turned = np.array([0.0, slope, 0.0, 0.0, 0.0])
    energy = band.energy(own, tyre.ring.hardening, tyre.ring.core, 0.0, length, zero, turned)
    assert energy == pytest.approx(0.5 * length * (own[4, 4] + own[5, 5]) * slope**2, rel=1e-6)


def test_the_contact_law_with_a_compliance_in_series(tyre):
    w = np.array(tyre.ring.dimensions)
    assert w[places.COMPLIANCE] > 0.05
    hard = w.copy()
    hard[places.COMPLIANCE] = 0.0
    depth = np.linspace(-0.1, 0.5, 121)
    pressure, slope, *_ = ground.traction(w, depth, 0.0 * depth)
    assert np.all(pressure[depth <= 0] == 0.0)
    # what the compliance takes away is what the hard law does not see
    left = depth - w[places.COMPLIANCE] * pressure
    np.testing.assert_allclose(ground.traction(hard, left, 0.0 * left)[0], pressure, atol=1e-9)
    numeric = np.gradient(pressure, depth)
    inner = slice(25, -1)
    np.testing.assert_allclose(slope[inner], numeric[inner], rtol=0.05)


@pytest.mark.skipif(not HAS_NUMBA, reason="needs numba")
def test_compiled_kernel_gives_the_same_system(tyre, state):
    from nptcs.ring.kernel import numba_kernel

    u, anchor = state
    ours = numpy_kernel.assemble(tyre.ring, u, RISE, anchor)
    compiled = numba_kernel.assemble(tyre.ring, u, RISE, anchor)
    for name in ("diagonal", "upper", "lower", "force", "slope", "row", "coordinates"):
        one, other = getattr(ours, name), getattr(compiled, name)
        np.testing.assert_allclose(other, one, rtol=0, atol=1e-12 * np.abs(one).max())
    assert compiled.reaction_n == pytest.approx(ours.reaction_n, rel=1e-12)


@pytest.mark.parametrize("count", [3, 4, 11])
def test_cyclic_solutions_agree_with_a_dense_one(count):
    random = np.random.default_rng(count)
    diagonal, upper, lower = random.normal(size=(3, count, 5, 5))
    diagonal = diagonal + 8 * np.eye(5)
    rhs = random.normal(size=(count, 5, 2))
    system = type("Blocks", (), {"diagonal": diagonal, "upper": upper, "lower": lower})
    expected = np.linalg.solve(dense(system), rhs.reshape(-1, 2)).reshape(rhs.shape)
    np.testing.assert_allclose(numpy_kernel.solve(diagonal, upper, lower, rhs), expected, rtol=1e-9)
    found = rhs.copy()
    none = NO_FEET
    eliminate(diagonal.copy(), upper, lower, found, none.nodes, none.lever, none.hold)
    np.testing.assert_allclose(found, expected, rtol=1e-9)


def test_contact_options_reach_the_ring(table):
    contact = GroundContact(friction=0.7, penalty_mpa_per_mm=11.0)
    own = ring_tyre(
        TyreGeometry(), table, 5.0, RingOptions(contact=contact), kernel="numpy"
    ).ring.dimensions
    assert own[places.FRICTION] == 0.7
    assert own[places.STIFF] == 11.0
