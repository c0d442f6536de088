"""A strip of plate alone, bent at its end, against classical lamination theory."""

import numpy as np
import pytest

from nptcs.fe.spoke.element_groups import plate_groups
from nptcs.fe.spoke.embedded_plates import straight_group
from nptcs.fe.spoke.mesh import ElementSet
from nptcs.laminate import abd

LAYER = 1.0
LENGTH, WIDTH = 60.0, 5.0
ELEMENTS = 12


def strip():
    """Elements of the plate's kind in a row along z, the thickness along x."""
    z = np.linspace(0.0, LENGTH, 2 * ELEMENTS + 1)
    y = np.linspace(-WIDTH / 2.0, WIDTH / 2.0, 3)
    x = np.array([-LAYER / 2.0, LAYER / 2.0])
    grid = np.stack(np.meshgrid(z, y, x, indexing="ij"), axis=-1)[..., ::-1]
    positions = grid.reshape(-1, 3)
    numbers = np.arange(len(positions)).reshape(len(z), 3, 2)
    nodes = np.array(
        [numbers[2 * e : 2 * e + 3].transpose(2, 1, 0).ravel() for e in range(ELEMENTS)]
    )
    return positions, ElementSet(nodes, positions[nodes], np.zeros(ELEMENTS, dtype=int))


def end_rotation(ply, angle, thickness, moment, held=False, embedded=False):
    """Rotation of the end of a cantilever per unit moment, small: one linear solve.

    `held` stops every sideways displacement, as a wide plate would; `embedded` keeps the
    mid-surface straight across the width.
    """
    positions, elements = strip()
    axes = np.array([[[0.0, 0.0, -1.0], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0]]])
    blocks = plate_groups(elements, axes, LAYER, ply, angle, thickness)
    if embedded:
        blocks.append(straight_group(elements, 1, ply["e2_mpa"]))
    size = positions.size
    matrix = np.zeros((size, size))
    for block in blocks:
        response = block.respond(np.zeros_like(positions))
        dofs = (block.nodes[:, :, None] * 3 + np.arange(3)).reshape(ELEMENTS, -1)
        for d, k in zip(dofs, response.tangent, strict=True):
            matrix[np.ix_(d, d)] += k
    fixed = np.zeros_like(positions, dtype=bool)
    root = positions[:, 2] == 0.0
    fixed[root, 2] = True
    fixed[root & (positions[:, 0] < 0), 0] = True
    fixed[np.flatnonzero(root & (positions[:, 1] == 0.0)), 1] = True
    if held:
        fixed[:, 1] = True
    free = np.flatnonzero(~fixed.ravel())
    load = np.zeros_like(positions)
    end = positions[:, 2] == LENGTH
    # Simpson's weights across the width carry a uniform line load
    share = np.where(positions[:, 1] == 0.0, 4.0, 1.0) / 6.0
    load[end, 2] = np.sign(positions[end, 0]) * share[end] * moment / LAYER
    moved = np.zeros(size)
    moved[free] = np.linalg.solve(matrix[np.ix_(free, free)], load.ravel()[free])
    z = moved.reshape(-1, 3)[:, 2]
    back = end & (positions[:, 1] == 0.0)
    return (z[back & (positions[:, 0] > 0)] - z[back & (positions[:, 0] < 0)])[0] / LAYER


@pytest.mark.parametrize("thickness", [1.2, 2.4])
@pytest.mark.parametrize("angle", [0.0, 30.0, 45.0, 90.0])
def test_a_free_strip_bends_by_the_inverse_abd(ply, angle, thickness):
    compliance = np.linalg.inv(abd(ply, angle, thickness))
    wanted = compliance[3, 3] * LENGTH / WIDTH
    assert end_rotation(ply, angle, thickness, 1.0) == pytest.approx(wanted, rel=0.02)


def test_without_coupling_the_strip_would_be_stiffer(ply):
    """The coupling B16 is there: leaving it out is far outside the tolerance above."""
    stiffness = abd(ply, 30.0, 1.2)
    alone = np.linalg.inv(stiffness[3:, 3:])[0, 0]
    assert np.linalg.inv(stiffness)[3, 3] > 1.3 * alone


def test_a_strip_held_sideways_bends_by_the_condensed_bending_stiffness(ply):
    stiffness = abd(ply, 0.0, 1.8)
    wanted = LENGTH / WIDTH / stiffness[3, 3]
    assert end_rotation(ply, 0.0, 1.8, 1.0, held=True) == pytest.approx(wanted, rel=0.02)


@pytest.mark.parametrize("angle", [30.0, 60.0, 75.0])
def test_an_embedded_strip_cannot_bow_across_its_width(ply, angle):
    """Rigid in transverse shear, its sections turn with the straight mid-surface: κ22 = 0."""
    rigid = {**ply, "g13_mpa": 1e6, "g23_mpa": 1e6}
    kept = [0, 1, 2, 3, 5]
    compliance = np.linalg.inv(abd(ply, angle, 1.8)[np.ix_(kept, kept)])
    wanted = compliance[3, 3] * LENGTH / WIDTH
    assert end_rotation(rigid, angle, 1.8, 1.0, embedded=True) == pytest.approx(wanted, rel=0.02)


def test_an_embedded_strip_falls_from_60_to_75_degrees_and_rises_to_90(published_ply):
    """The paper's sign and, for the strip that may bow, the other one."""
    held, free = (
        [1.0 / end_rotation(published_ply, a, 1.8, 1.0, embedded=e) for a in (60.0, 75.0, 90.0)]
        for e in (True, False)
    )
    assert held[1] < 0.97 * held[0]
    assert held[2] > held[1]
    assert free[0] < free[1] < free[2]
