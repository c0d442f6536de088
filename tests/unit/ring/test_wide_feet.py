"""Feet that act over their width: weights of nodes, squeeze of the band, both kernels."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from scipy.optimize import root

from nptcs.config.solvers.fe import GroundContact
from nptcs.config.solvers.ring import RingElements, RingOptions
from nptcs.config.solvers.tyre import TyreGeometry
from nptcs.ring.feet import wide_feet
from nptcs.ring.kernel import numpy_kernel
from nptcs.ring.kernel.compiled import HAS_NUMBA
from nptcs.ring.kernel.cyclic_elimination import eliminate
from nptcs.ring.kernel.elementwise import places
from nptcs.ring.kernel.numpy_spokes import SpokeStates, spoke_states
from nptcs.ring.kernel.system import FootTangent
from nptcs.ring.tyre import ring_tyre

WIDTH_MM, RADIUS_MM = 16.0, 300.0
FINE = RingOptions(
    mesh=RingElements(elements_per_pitch=1, refined_deg=13, refinement=10),
    contact=GroundContact(penalty_mpa_per_mm=50.0, smoothing_mm=0.1),
)
RISE = 4.0


@pytest.fixture(scope="module")
def tyre(table):
    return ring_tyre(TyreGeometry(), table, 5.0, FINE, kernel="numpy")


@pytest.fixture(scope="module")
def state(tyre):
    """Return unknowns without a pattern, and anchors away from the surface."""
    random = np.random.default_rng(5)
    u = random.normal(size=(len(tyre.nodes.theta), 5)) * [0.1, 0.1, 0.003, 0.003, 0.05]
    return u, tyre.surface(np.zeros_like(u))[0] + 0.05


def test_shares_are_the_means_of_what_is_linear_between_the_nodes(tyre):
    feet = wide_feet(tyre.nodes, RADIUS_MM, WIDTH_MM)
    arm = np.linspace(-0.5, 0.5, 200001) * WIDTH_MM
    for node in range(len(feet.angle)):
        shape = np.interp(arm / RADIUS_MM, feet.angle, np.eye(len(feet.angle))[node])
        assert feet.mean[node] == pytest.approx(shape.mean(), abs=1e-5)
        turn = np.mean(arm * shape) / np.mean(arm**2)
        assert feet.turn[node] == pytest.approx(turn, abs=1e-5)


def test_feet_are_wide_where_the_elements_are_fine(tyre):
    nodes, feet = tyre.nodes, tyre.ring.wide
    wide = np.flatnonzero(feet.place >= 0)
    assert np.abs(np.degrees(nodes.theta[nodes.feet[wide]])).max() == pytest.approx(12.0)
    assert len(wide) == 5
    middle = feet.nodes[feet.place[wide], feet.nodes.shape[1] // 2]
    np.testing.assert_array_equal(middle, nodes.feet[wide])
    np.testing.assert_allclose(nodes.theta[feet.nodes[0]] - nodes.theta[middle.min()], feet.angle)


@pytest.mark.parametrize("refined_deg", [0.0, 180.0])
def test_no_foot_reaches_over_the_last_node(table, refined_deg):
    mesh = RingElements(elements_per_pitch=10, refinement=1, refined_deg=refined_deg)
    own = ring_tyre(TyreGeometry(), table, 5.0, RingOptions(mesh=mesh), kernel="numpy")
    feet = own.ring.wide
    assert (feet.place >= 0).all()
    assert feet.nodes.min() >= 0
    assert feet.nodes.max() < len(own.nodes.theta) - 2
    assert len(np.unique(feet.nodes)) == feet.nodes.size


def test_feet_that_overlap_are_refused(tyre):
    with pytest.raises(ValueError, match="overlap on 60 spokes"):
        wide_feet(tyre.nodes, RADIUS_MM, 32.0)


def test_the_squeezed_spoke_is_in_equilibrium_with_the_band(tyre, state):
    """z = m - C E'(z) by another solver."""
    u, _ = state
    # these spokes are soft: a band that gives 50 times as much shows what is wrong
    ring = replace(tyre.ring, squeeze=50.0 * tyre.ring.squeeze)
    found = spoke_states(ring, u)
    stiff = replace(ring, squeeze=np.zeros(2))
    felt = spoke_states(stiff, u).motion
    own = np.flatnonzero(tyre.ring.wide.place >= 0)
    soft = np.array([ring.squeeze[0], 0.0, ring.squeeze[1]])[:, None]
    assert np.abs(found.motion - felt)[:, own].max() > 1e-3

    def gap(flat):
        motion = flat.reshape(3, -1)
        push = SpokeStates.of(ring, motion).push
        return (motion - felt[:, own] + soft * push).ravel()

    exact = root(gap, felt[:, own].ravel(), tol=1e-14).x.reshape(3, -1)
    push = SpokeStates.of(ring, exact).push
    np.testing.assert_allclose(found.push[:, own], push, rtol=1e-7, atol=1e-7 * np.abs(push).max())
    others = tyre.ring.wide.place < 0
    np.testing.assert_array_equal(found.motion[:, others], felt[:, others])


def product(system, x):
    """Tangent times x (nodes, 5)."""
    y = np.einsum("nij,nj->ni", system.diagonal, x)
    y += np.einsum("nij,nj->ni", system.upper, np.roll(x, -1, axis=0))
    y += np.roll(np.einsum("nij,nj->ni", system.lower, x), 1, axis=0)
    feet = system.feet
    for nodes, lever, hold in zip(feet.nodes, feet.lever, feet.hold, strict=True):
        y[nodes] += np.einsum("pia,i->pa", lever, hold @ np.einsum("pia,pa->i", lever, x[nodes]))
    return y


def test_residual_and_tangent_are_derivatives(tyre, state):
    u, anchor = state
    system = numpy_kernel.assemble(tyre.ring, u, RISE, anchor)
    lifted = numpy_kernel.assemble(tyre.ring, u, -50.0, anchor)
    random = np.random.default_rng(6)
    covered = tyre.ring.wide.nodes.ravel()
    for _ in range(3):
        move = np.zeros_like(u)
        move[covered] = random.normal(size=(len(covered), 5)) * [0.1, 0.1, 0.003, 0.003, 0.05]
        up, down = u + 1e-4 * move, u - 1e-4 * move
        energy = (sum(tyre.energy(up).values()) - sum(tyre.energy(down).values())) / 2e-4
        assert np.sum(lifted.force * move) == pytest.approx(energy, rel=1e-6)
        forces = [numpy_kernel.assemble(tyre.ring, v, RISE, anchor).force for v in (up, down)]
        slope = (forces[0] - forces[1]) / 2e-4
        found = product(system, move)
        np.testing.assert_allclose(found, slope, atol=1e-6 * np.abs(slope).max())


def test_a_wide_foot_turns_and_moves_with_a_rigid_ring(tyre):
    """A rotation of the whole ring about a foot's middle is the motion of the foot."""
    ring = tyre.ring
    w, own = ring.dimensions, np.flatnonzero(ring.wide.place >= 0)[0]
    turn, angle = 1e-4, ring.theta[ring.feet[own]]
    place = tyre.nodes.positions(tyre.section.radius_mm)
    inner = tyre.section.radius_mm - w[places.HALF] - w[places.FOOT]
    middle = inner * np.array([np.sin(angle), -np.cos(angle)])
    u = np.zeros((len(place), 5))
    u[:, :2] = turn * np.stack([-(place - middle)[:, 1], (place - middle)[:, 0]], axis=1)
    u[:, 2:4] = -turn
    free = replace(ring, squeeze=np.zeros(2))
    motion = spoke_states(free, u).motion[:, own]
    np.testing.assert_allclose(motion[:2], 0.0, atol=5e-6)
    assert motion[2] == pytest.approx(-turn, rel=0.03)


@pytest.mark.skipif(not HAS_NUMBA, reason="needs numba")
def test_compiled_kernel_gives_the_same_feet(tyre, state):
    from nptcs.ring.kernel import numba_kernel

    u, anchor = state
    ours = numpy_kernel.assemble(tyre.ring, u, RISE, anchor)
    compiled = numba_kernel.assemble(tyre.ring, u, RISE, anchor)
    for name in ("diagonal", "force", "coordinates"):
        one, other = getattr(ours, name), getattr(compiled, name)
        np.testing.assert_allclose(other, one, rtol=0, atol=1e-12 * np.abs(one).max())
    for name in ("lever", "hold"):
        one, other = getattr(ours.feet, name), getattr(compiled.feet, name)
        np.testing.assert_allclose(other, one, rtol=0, atol=1e-12 * np.abs(one).max())


@pytest.mark.parametrize("kernel", ["numpy", "numba"])
def test_the_squeeze_of_a_near_iterate_leads_to_the_same_equilibrium(table, state, kernel):
    """Started from a squeeze that is wrong, the forces are wrong by the square of that."""
    if kernel == "numba" and not HAS_NUMBA:
        pytest.skip("needs numba")
    tyre = ring_tyre(TyreGeometry(), table, 5.0, FINE, kernel=kernel)
    u, anchor = state
    alone = tyre.kernel.assemble(tyre.ring, u, RISE, anchor)
    assert np.abs(alone.squeezed[:, [0, 2]]).min() > 0.0
    off = []
    for wrong in (0.1, 0.2):
        squeezed = alone.squeezed + wrong * np.array([1.0, 0.0, 0.01])
        found = tyre.kernel.assemble(tyre.ring, u, RISE, anchor, squeezed)
        off.append(np.abs(found.force - alone.force).max() / np.abs(alone.force).max())
        assert np.abs(found.squeezed - alone.squeezed).max() < 0.02 * wrong
    assert off[1] < 1e-3
    assert off[1] / off[0] == pytest.approx(4.0, rel=0.2)
    again = tyre.kernel.assemble(tyre.ring, u, RISE, anchor, alone.squeezed)
    np.testing.assert_allclose(again.force, alone.force, atol=1e-9 * np.abs(alone.force).max())


def test_feet_in_a_matrix_whose_rows_must_be_exchanged():
    random = np.random.default_rng(8)
    count, nodes = 14, np.array([[5, 6, 7], [9, 10, 11]])
    blocks = random.normal(size=(3, count, 5, 5))
    half = random.normal(size=(2, 3, 3))
    feet = FootTangent(nodes, random.normal(size=(2, 3, 3, 5)), half + half.swapaxes(1, 2))
    rhs = random.normal(size=(count, 5, 2))
    found = numpy_kernel.solve(*blocks, rhs, feet)
    system = SimpleNamespace(
        **dict(zip(("diagonal", "upper", "lower"), blocks, strict=True)), feet=feet
    )
    columns = [product(system, unit.reshape(count, 5)).ravel() for unit in np.eye(5 * count)]
    expected = np.linalg.solve(np.stack(columns, axis=1), rhs.reshape(-1, 2))
    np.testing.assert_allclose(found.reshape(-1, 2), expected, atol=1e-9 * np.abs(expected).max())


@pytest.mark.parametrize("transposed", [False, True])
def test_solutions_with_wide_feet(tyre, state, transposed):
    u, anchor = state
    system = numpy_kernel.assemble(tyre.ring, u, RISE, anchor)
    if transposed:
        diagonal, upper, lower = system.transposed()
        system = replace(system, diagonal=diagonal, upper=upper, lower=lower)
    blocks, feet = (system.diagonal, system.upper, system.lower), system.feet
    rhs = np.random.default_rng(7).normal(size=(len(u), 5, 2))
    scale = np.abs(system.diagonal).max()
    found = numpy_kernel.solve(*blocks, rhs, feet)
    compiled = rhs.copy()
    eliminate(blocks[0].copy(), *blocks[1:], compiled, feet.nodes, feet.lever, feet.hold)
    for solution in (found, compiled):
        for side in range(2):
            left = product(system, solution[:, :, side]) - rhs[:, :, side]
            assert np.abs(left).max() < 1e-12 * scale * np.abs(solution).max()
    blind = numpy_kernel.solve(*blocks, rhs)
    assert np.abs(blind - found).max() > 1e-5 * np.abs(found).max()
