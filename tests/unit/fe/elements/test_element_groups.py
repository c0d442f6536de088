"""Patch tests, closed forms of one element, and tangents against differences."""

import numpy as np
import pytest

from nptcs.fe.elements.groups import LinearGroup, RubberGroup
from nptcs.fe.elements.lagrange import gauss, jacobians, tensor_shape

C10 = 1.3
BULK = 2.0e6 * C10


def grid(orders, wobble, seed=3):
    """Two elements in a row along x, with all nodes moved about at random."""
    counts = (2 * orders[0] + 1, orders[1] + 1, orders[2] + 1)
    axes = [np.linspace(0.0, length, n) for length, n in zip((2.0, 1.0, 1.0), counts, strict=True)]
    positions = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 3)
    numbers = np.arange(len(positions)).reshape(counts)
    nodes = np.array([numbers[i : i + orders[0] + 1].ravel() for i in (0, orders[0])])
    rng = np.random.default_rng(seed)
    return positions + wobble * rng.uniform(-1.0, 1.0, positions.shape), nodes


def rubber(orders=(2, 2, 2), wobble=0.05):
    positions, nodes = grid(orders, wobble)
    points, weights = gauss([order + 1 for order in orders])
    _, slope = tensor_shape(orders, points)
    gradient, volume = jacobians(slope, positions[nodes])
    modes = np.column_stack([np.ones(len(points)), points])
    return positions, RubberGroup(nodes, gradient, volume * weights, modes, C10, BULK)


def linear(stiffness, wobble=0.05):
    positions, nodes = grid((1, 2, 2), wobble)
    points, weights = gauss((2, 3, 3))
    _, slope = tensor_shape((1, 2, 2), points)
    gradient, volume = jacobians(slope, positions[nodes])
    return positions, LinearGroup(
        nodes, gradient, volume * weights, np.repeat(stiffness[None], len(points), axis=0)
    )


def turn(angle):
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])


def settle(block, displacement):
    """Let the pressures follow a displacement that is held."""
    for _ in range(3):
        block.respond(displacement)
        block.follow(np.zeros_like(displacement))


def interior_force(block, positions, displacement):
    total = np.zeros(positions.size)
    response = block.respond(displacement)
    dofs = (block.nodes[:, :, None] * 3 + np.arange(3)).reshape(len(block.nodes), -1)
    np.add.at(total, dofs, response.force)
    inside = np.all((positions > 0.3) & (positions < [1.7, 0.7, 0.7]), axis=1)
    return np.abs(total.reshape(-1, 3)[inside]).max(), np.abs(total).max()


@pytest.mark.parametrize("stretch", [0.8, 1.5])
def test_patch_and_uniaxial_closed_form(stretch):
    positions, block = rubber()
    across = stretch**-0.5
    displacement = positions * (np.array([stretch, across, across]) - 1.0)
    # P = 2 C10 (λ - λ⁻²); the pressure follows from free sides: p = -(S_iso)_22 part
    scale = 2.0 * C10
    block.pressure[:, 0] = -scale * (across**2 - (stretch**2 + 2.0 * across**2) / 3.0)
    block.bulk_mpa = np.inf
    block._inverse_mass = np.zeros_like(block._inverse_mass)
    inside, largest = interior_force(block, positions, displacement)
    assert inside < 1e-12 * max(largest, 1.0)
    response = block.respond(displacement)
    energy = C10 * (stretch**2 + 2.0 / stretch - 3.0)
    volume = block.weight.sum()
    assert response.energy == pytest.approx(energy * volume, rel=1e-9)
    # virtual work of a uniform stretch rate along x: P11 V
    rate = np.zeros_like(positions)
    rate[:, 0] = positions[:, 0]
    work = np.sum(response.force.reshape(2, -1, 3) * rate[block.nodes])
    assert work == pytest.approx(2.0 * C10 * (stretch - stretch**-2) * volume, rel=1e-9)


def test_simple_shear_closed_form():
    positions, block = rubber()
    shear = 0.7
    displacement = np.zeros_like(positions)
    displacement[:, 0] = shear * positions[:, 1]
    response = block.respond(displacement)
    assert response.energy == pytest.approx(C10 * shear**2 * block.weight.sum())
    rate = np.zeros_like(positions)
    rate[:, 0] = positions[:, 1]
    work = np.sum(response.force.reshape(2, -1, 3) * rate[block.nodes])
    assert work == pytest.approx(2.0 * C10 * shear * block.weight.sum())


def test_a_rigid_turn_costs_nothing():
    rng = np.random.default_rng(0)
    root = rng.normal(size=(6, 6))
    for positions, block in (linear(root @ root.T), rubber()):
        displacement = positions @ (turn(1.1) - np.eye(3)).T
        response = block.respond(displacement)
        assert abs(response.energy) < 1e-12
        assert np.abs(response.force).max() < 1e-7


@pytest.mark.parametrize("kind", ["rubber", "linear"])
def test_forces_and_tangents_are_derivatives_of_the_energy(kind):
    rng = np.random.default_rng(1)
    root = rng.normal(size=(6, 6))
    positions, block = rubber() if kind == "rubber" else linear(root @ root.T)
    if kind == "rubber":
        block.bulk_mpa = 50.0
        block.__post_init__()
    displacement = 0.05 * rng.normal(size=positions.shape)
    direction = rng.normal(size=positions.shape)

    def state(step):
        moved = displacement + step * direction
        if kind == "rubber":
            settle(block, moved)
        response = block.respond(moved)
        local = direction[block.nodes].reshape(2, -1)
        return (
            response.energy,
            np.sum(response.force * local),
            np.einsum("en,enm,em->", local, response.tangent, local),
        )

    step = 1e-5
    ahead, behind, here = state(step), state(-step), state(0.0)
    assert (ahead[0] - behind[0]) / (2 * step) == pytest.approx(here[1], rel=1e-6)
    assert (ahead[1] - behind[1]) / (2 * step) == pytest.approx(here[2], rel=1e-6)


def test_plane_strain_equals_a_slice_of_the_solid():
    orders = (2, 2)
    points, weights = gauss((3, 3))
    axis = np.linspace(0.0, 1.0, 3)
    positions = np.stack(np.meshgrid(axis, axis, indexing="ij"), axis=-1).reshape(-1, 2)
    _, slope = tensor_shape(orders, points)
    gradient, area = jacobians(slope, positions[None])
    modes = np.ones((9, 1))
    block = RubberGroup(np.arange(9)[None], gradient, area * weights, modes, C10, BULK)
    displacement = np.zeros_like(positions)
    displacement[:, 0] = 0.4 * positions[:, 1]
    assert block.respond(displacement).energy == pytest.approx(C10 * 0.16)


def test_a_folded_element_is_refused():
    positions, block = rubber()
    with pytest.raises(FloatingPointError, match="inside out"):
        block.respond(-1.5 * positions)


def stiff():
    root = np.random.default_rng(0).normal(size=(6, 6))
    return linear(1e5 * root @ root.T)


@pytest.mark.parametrize("make", [rubber, stiff])
def test_forces_alone_are_those_of_the_whole_response(make):
    positions, block = make()
    rng = np.random.default_rng(2)
    displacement = 0.05 * rng.normal(size=positions.shape)
    block.respond(displacement)
    block.follow(0.01 * rng.normal(size=positions.shape))
    response = block.respond(displacement)
    energy, force = block.forces(displacement)
    assert energy == pytest.approx(response.energy)
    assert force == pytest.approx(response.force, rel=1e-9, abs=1e-9 * np.abs(force).max())


def test_stresses_follow_a_step_to_first_order():
    positions, block = stiff()
    rng = np.random.default_rng(3)
    displacement, step = (0.05 * rng.normal(size=positions.shape) for _ in range(2))

    def missed(part):
        block.release()
        block.respond(displacement)
        block.follow(part * step)
        followed = block.inner()
        block.release()
        block.respond(displacement + part * step)
        return np.abs(followed - block.inner()).max() / np.abs(block.inner()).max()

    assert missed(1e-3) < 1e-3
    assert missed(1e-3) == pytest.approx(missed(1e-2) / 100.0, rel=0.1)


def test_half_a_step_takes_half_of_the_stress():
    positions, block = stiff()
    displacement = 0.05 * np.random.default_rng(4).normal(size=positions.shape)
    block.respond(np.zeros_like(positions))
    before = block.inner()
    block.follow(displacement)
    whole = block.inner()
    block.put_inner(before)
    block.follow(displacement, 0.5)
    assert block.inner() == pytest.approx(0.5 * (before + whole))


def solved(block, displacement, free, tries=20):
    """Return how many steps Newton's method takes for the free dofs of a group."""
    dofs = (block.nodes[:, :, None] * 3 + np.arange(3)).reshape(len(block.nodes), -1)
    for count in range(tries):
        response = block.respond(displacement)
        force, matrix = np.zeros(displacement.size), np.zeros((displacement.size,) * 2)
        for where, own, stiffness in zip(dofs, response.force, response.tangent, strict=True):
            force[where] += own
            matrix[np.ix_(where, where)] += stiffness
        step = np.zeros(displacement.size)
        step[free] = -np.linalg.solve(matrix[np.ix_(free, free)], force[free])
        step = step.reshape(-1, 3)
        displacement = displacement + step
        block.follow(step)
        if np.abs(step).max() < 1e-10:
            return count
    return tries


def test_a_stretched_guess_of_a_turned_plate_settles_at_once():
    """Stresses are unknowns too: those of the stretched guess would mislead the first tangents."""
    positions, block = linear(1e5 * np.diag([1.0, 1.0, 1.0, 0.3, 0.3, 0.3]), wobble=0.0)
    turned = positions @ (turn(0.9) - np.eye(3)).T
    free = np.repeat(positions[:, 0] > 0.0, 3).nonzero()[0]
    guess = turned + np.where(positions[:, :1] > 0.0, 0.1 * (positions + turned), 0.0)
    block.respond(np.zeros_like(positions))
    block.put_inner(np.zeros_like(block.inner()))
    own = solved(block, guess, free)

    def forget(step, part=1.0):
        block.release()

    block.release()
    block.follow = forget
    assert own < solved(block, guess, free)
