import numpy as np
import pytest

from nptcs.fe.elements.groups import LinearGroup, RubberGroup
from nptcs.fe.elements.lagrange import gauss, jacobians, tensor_shape
from nptcs.fe.output.fields import (
    at_points,
    extreme,
    fibre_stress,
    lattice,
    linear_energy,
    rubber_at,
    rubber_energy,
    rubber_fields,
)
from nptcs.fe.spoke.mesh import ElementSet
from nptcs.laminate import rotated_stiffness

CORNERS = (lattice(3, 3) * [1.0, 2.0, 1.5])[None]
NODES = np.arange(27)[None]


@pytest.fixture
def brick():
    points, weights = gauss((3, 3, 3))
    gradient, volume = jacobians(tensor_shape((2, 2, 2), points)[1], CORNERS)
    modes = np.column_stack([np.ones(27), points])
    return RubberGroup(NODES, gradient, volume * weights, modes, 1.3, 5200.0)


def stretched(factors):
    return CORNERS[0] * (np.array(factors) - 1.0)


@pytest.mark.parametrize("stretch", [0.6, 1.0, 1.8])
def test_one_brick_in_uniaxial_tension(brick, stretch):
    """σ = 2 C10 (λ² - 1/λ), its von Mises value the same, its mean a third of it."""
    stress = 2.0 * 1.3 * (stretch**2 - 1.0 / stretch)
    brick.pressure[0, 0] = stress / 3.0
    displacement = stretched([stretch, stretch**-0.5, stretch**-0.5])
    at_gauss = rubber_fields(brick, displacement)
    at_nodes = rubber_at(brick, (2, 2, 2), CORNERS, displacement, lattice(3, 3))
    energy = 1.3 * (stretch**2 + 2.0 / stretch - 3.0)
    for fields in (at_gauss, at_nodes):
        assert fields.mises == pytest.approx(abs(stress), rel=1e-10, abs=1e-10)
        assert fields.pressure == pytest.approx(-stress / 3.0)
        assert fields.energy_density == pytest.approx(energy, rel=1e-3, abs=1e-10)


def test_simple_shear(brick):
    """σ12 = 2 C10 γ, σ11 - σ22 = 2 C10 γ²."""
    shear = 0.7
    displacement = np.zeros_like(CORNERS[0])
    displacement[:, 0] = shear * CORNERS[0, :, 1]
    first, cross = 2.6 * shear**2, 2.6 * shear
    expected = np.sqrt(first**2 + 3.0 * cross**2)
    assert rubber_fields(brick, displacement).mises == pytest.approx(expected)


def test_a_rigid_turn_leaves_no_stress(brick):
    c, s = np.cos(0.8), np.sin(0.8)
    turned = CORNERS[0] @ np.array([[c, s, 0.0], [-s, c, 0.0], [0.0, 0.0, 1.0]]) - CORNERS[0]
    fields = rubber_fields(brick, turned)
    assert fields.mises == pytest.approx(0.0, abs=1e-12)
    assert rubber_energy(brick, turned) == pytest.approx(0.0, abs=1e-12)


def test_energies_of_elements_add_up_to_the_blocks(brick):
    rng = np.random.default_rng(0)
    displacement = 0.05 * rng.normal(size=(27, 3))
    brick.pressure = 0.1 * rng.normal(size=(1, 4))
    # the block's energy is the one before its pressure is brought up to the displacement
    assert rubber_energy(brick, displacement).sum() == pytest.approx(
        brick.respond(displacement).energy
    )
    linear = LinearGroup(
        NODES, brick.gradient, brick.weight, np.tile(np.diag([9.0, 8, 7, 6, 5, 4]), (27, 1, 1))
    )
    assert linear_energy(linear, displacement).sum() == pytest.approx(
        linear.respond(displacement).energy
    )


@pytest.mark.parametrize("angle", [0.0, 30.0, 45.0, 90.0])
def test_fibre_stress_is_the_plys_own_law(brick, published_ply, angle):
    """Stretch the plate along its length: both plies see ε c², ε s² along and across the fibres."""
    stiffness = np.zeros((27, 6, 6))
    places = np.ix_([0, 1, 3], [0, 1, 3])
    for i in range(26):
        stiffness[i][places] = rotated_stiffness(published_ply, angle if i < 13 else -angle)
    keep = slice(0, 26)
    block = LinearGroup(NODES, brick.gradient[:, keep], brick.weight[:, keep], stiffness[keep])
    strain = 1e-4
    stress = fibre_stress(block, stretched([np.sqrt(1.0 + 2.0 * strain), 1.0, 1.0]), angle)
    ply, c, s = published_ply, np.cos(np.radians(angle)), np.sin(np.radians(angle))
    scale = 1.0 / (1.0 - ply["nu12"] ** 2 * ply["e2_mpa"] / ply["e1_mpa"])
    expected = scale * strain * (ply["e1_mpa"] * c * c + ply["nu12"] * ply["e2_mpa"] * s * s)
    assert stress == pytest.approx(np.full((1, 26), expected), rel=1e-6)


def test_the_extreme_keeps_its_sign():
    assert extreme(np.array([[1.0, -3.0, 2.0], [4.0, 0.0, -1.0]])).tolist() == [-3.0, 4.0]


def test_positions_of_elements_that_are_linear_in_one_direction():
    corners = (np.array([[x, y, z] for x in (0, 2) for y in (0, 1, 2) for z in (0, 1, 2)]))[None]
    elements = ElementSet(np.arange(18)[None], corners.astype(float), np.zeros(1, dtype=int))
    moved = corners[0] * [0.5, 0.0, 0.0]
    position, displacement = at_points(elements, (1, 2, 2), moved, lattice(3, 3))
    assert position[0] == pytest.approx(lattice(3, 3) + 1.0)
    assert displacement[0, :, 0] == pytest.approx(0.5 * (lattice(3, 3)[:, 0] + 1.0))
