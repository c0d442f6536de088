"""The same spoke mesh in CalculiX and in the package's kernel."""

import re
import shutil
import subprocess
from dataclasses import replace

import numpy as np
import pytest

from nptcs.config.solvers.fe import SpokeGeometry, SpokeMesh
from nptcs.decks.calculix import (
    BrickMesh,
    brick_mesh,
    deck,
    spoke_deck,
    total_forces,
    true_thickness,
)
from nptcs.fe.elements.groups import LinearGroup, RubberGroup
from nptcs.fe.elements.lagrange import gauss, jacobians, tensor_shape
from nptcs.fe.spoke.equilibrium import SpokeModel
from nptcs.fe.spoke.period import SpokeDesign

# Abaqus and CalculiX number the corners around; the tensor product runs z fastest
CORNERS = [0, 4, 3, 7, 1, 5, 2, 6]


# a stout section for this check alone: it must not change with the calibrated one
SECTION = SpokeGeometry(
    leg_angle_deg=28.06,
    leg_thickness_mm=4.35,
    block_thickness_mm=11.98,
    block_half_length_mm=8.79,
    foot_thickness_mm=7.66,
    plate_foot_gap_mm=3.49,
    plate_mid_gap_mm=4.14,
)


def small_design(ply, angle=30.0):
    design = SpokeDesign(
        geometry=SECTION,
        mesh=SpokeMesh(rows=(1, 1, 2, 1, 1, 1), bulk_to_shear_ratio=100.0),
        pitch_mm=10.0,
        plate_width_mm=5.0,
        thickness_mm=1.2,
        angle_deg=angle,
        c10_mpa=1.0,
        ply=ply,
        plates=21,
        plate_coupling="conforming",
    )
    return true_thickness(design)


def linear_bricks(mesh):
    """The corners of the 20-node bricks alone."""
    sets = {name: nodes[:, :8] for name, nodes in mesh.sets.items()}
    used = set(np.concatenate([nodes.ravel() for nodes in sets.values()]).tolist())
    positions = {n: p for n, p in mesh.positions.items() if n in used}

    def keep(nodes):
        return np.array([n for n in nodes if n in used])

    pairs = np.array([pair for pair in mesh.pairs if pair[0] in used])
    return BrickMesh(positions, sets, keep(mesh.bottom), keep(mesh.top), pairs, {})


def compliance_of(ply):
    s = np.zeros((6, 6))
    e1, e2, e3 = ply["e1_mpa"], ply["e2_mpa"], ply["e3_mpa"]
    s[:3, :3] = np.diag([1 / e1, 1 / e2, 1 / e3])
    s[0, 1] = s[1, 0] = -ply["nu12"] / e1
    s[0, 2] = s[2, 0] = -ply["nu13"] / e1
    s[1, 2] = s[2, 1] = -ply["nu23"] / e2
    s[3, 3], s[4, 4], s[5, 5] = 1 / ply["g12_mpa"], 1 / ply["g23_mpa"], 1 / ply["g13_mpa"]
    return s


def kernel_blocks(mesh, design):
    """Fully integrated 8-node bricks in the package's own blocks: the element C3D8."""
    number = {node: i for i, node in enumerate(mesh.positions)}
    positions = np.array(list(mesh.positions.values()))
    points, weights = gauss((2, 2, 2))
    _, slope = tensor_shape((1, 1, 1), points)
    stiffness = np.repeat(np.linalg.inv(compliance_of(design.ply))[None], 8, axis=0)
    lean = np.radians(design.geometry.leg_angle_deg)
    blocks = []
    for name, nodes in mesh.sets.items():
        local = np.vectorize(number.get)(nodes[:, CORNERS])
        gradient, volume = jacobians(slope, positions[local])
        if name == "RUBBER":
            bulk = design.mesh.bulk_to_shear_ratio * 2.0 * design.c10_mpa
            # one pressure per point is the displacement formulation
            blocks.append(
                RubberGroup(local, gradient, volume * weights, np.eye(8), design.c10_mpa, bulk)
            )
            continue
        leg, ply = name.split("_")
        slope_angle = -lean if leg == "LOWER" else lean
        fibre = np.radians(design.angle_deg) * (1 if ply == "1" else -1)
        along = np.array([np.sin(slope_angle), 0.0, np.cos(slope_angle)])
        across = np.array([0.0, 1.0, 0.0])
        one = np.cos(fibre) * along + np.sin(fibre) * across
        two = np.cos(fibre) * across - np.sin(fibre) * along
        axes = np.stack([one, two, np.cross(one, two)], axis=1)
        frame = np.broadcast_to(axes, (*volume.shape, 3, 3))
        turned = np.einsum("egni,ij->egnj", gradient, axes)
        blocks.append(LinearGroup(local, turned, volume * weights, stiffness, frame))
    return positions, number, blocks


def solve_with_kernel(mesh, design, u_r):
    """Newton's method with dense algebra, written again, independently of `SpokeModel`."""
    positions, number, blocks = kernel_blocks(mesh, design)
    master = np.arange(len(positions))
    for far, near in mesh.pairs:
        master[number[far]] = number[near]
    top = [number[n] for n in mesh.top]
    held = set(top) | {number[n] for n in mesh.bottom}
    free_nodes = [i for i in range(len(positions)) if master[i] == i and i not in held]
    place = -np.ones(len(positions), dtype=int)
    place[free_nodes] = np.arange(len(free_nodes))
    place = place[master]
    displacement = np.zeros_like(positions)
    for part in np.linspace(0.0, u_r, 5)[1:]:
        displacement[top, 2] = part
        for _ in range(20):
            matrix = np.zeros((3 * len(free_nodes), 3 * len(free_nodes)))
            force, reaction = np.zeros(3 * len(free_nodes)), 0.0
            for block in blocks:
                response = block.respond(displacement)
                pulled = np.isin(block.nodes, top)
                reaction += response.force.reshape(*block.nodes.shape, 3)[pulled, 2].sum()
                where = place[block.nodes][:, :, None] * 3 + np.arange(3)
                where[place[block.nodes] < 0] = -1
                where = where.reshape(len(block.nodes), -1)
                for dofs, f, k in zip(where, response.force, response.tangent, strict=True):
                    inside = dofs >= 0
                    np.add.at(force, dofs[inside], f[inside])
                    np.add.at(matrix, np.ix_(dofs[inside], dofs[inside]), k[np.ix_(inside, inside)])
            step = -np.linalg.solve(matrix, force)
            move = np.zeros_like(positions)
            known = place >= 0
            move[known] = step.reshape(-1, 3)[place[known]]
            displacement = displacement + move
            for block in blocks:
                if isinstance(block, RubberGroup):
                    block.follow(move)
            if np.abs(step).max() < 1e-8:
                break
    return reaction


@pytest.mark.skipif(shutil.which("ccx") is None, reason="CalculiX (ccx) is not installed")
@pytest.mark.parametrize("u_r", [3.0, -8.0])
def test_calculix_gives_the_same_force_on_the_same_mesh(tmp_path, ply, u_r):
    design = small_design(ply)
    mesh = linear_bricks(brick_mesh(design))
    (tmp_path / "spoke.inp").write_text(deck(design, mesh, "C3D8", [u_r]))
    run = subprocess.run(["ccx", "spoke"], cwd=tmp_path, capture_output=True, text=True, check=True)
    assert not re.search(r"\*(WARNING|ERROR)", run.stdout)
    theirs = total_forces((tmp_path / "spoke.dat").read_text())[-1, 2]
    assert solve_with_kernel(mesh, design, u_r) == pytest.approx(theirs, rel=0.005)


def test_the_deck_is_complete(ply):
    text = spoke_deck(small_design(ply), [4.0, -20.0])
    assert text.count("*STEP") == text.count("*END STEP") == 2
    assert "TYPE=C3D20R, ELSET=LOWER_1" in text
    assert text.count("*ORIENTATION") == 4
    sections = re.findall(r"\*SOLID SECTION, ELSET=(\w+)", text)
    assert sorted(sections) == sorted(set(re.findall(r"\*ELEMENT, .*ELSET=(\w+)", text)))
    # lines of a deck hold at most 16 numbers
    assert max(line.count(",") for line in text.splitlines() if not line.startswith("*")) <= 16


def test_plies_of_true_thickness_are_required(ply):
    design = small_design(ply)
    thin = SpokeDesign(**{**vars(design), "thickness_mm": 2.0})
    with pytest.raises(ValueError, match="plate_layer_mm"):
        spoke_deck(thin, [1.0])


def test_totals_are_read_from_the_result_file():
    text = (
        "\n total force (fx,fy,fz) for set NTOP and time  0.1000000E+01\n\n"
        "        1.250000E+00 -2.000000E+00  3.500000E+01\n"
    )
    assert total_forces(text) == pytest.approx(np.array([[1.25, -2.0, 35.0]]))


@pytest.mark.parametrize("text", ["", "\n                        S T E P       1\n\n"])
def test_a_result_file_of_no_completed_step_contains_no_forces(text):
    assert total_forces(text).shape == (0, 3)


def test_a_plate_that_is_embedded_is_held_straight_by_equations(ply):
    design = replace(small_design(ply), plate_coupling="embedded")
    mesh = brick_mesh(design)
    # five elements along each leg's plate; the middle of the width has nodes at their ends only
    assert len(mesh.between) == 2 * 6
    for node, (first, last, part) in mesh.between.items():
        place = (1.0 - part) * mesh.positions[first] + part * mesh.positions[last]
        assert mesh.positions[node] == pytest.approx(place, abs=1e-9)
        assert np.ptp([mesh.positions[first][1], mesh.positions[last][1]]) == pytest.approx(5.0)
    held = spoke_deck(design, [1.0]).count("*EQUATION\n3\n")
    assert held == 3 * len(mesh.between)
    free = replace(design, plate_coupling="conforming")
    assert "*EQUATION\n3\n" not in spoke_deck(free, [1.0])


@pytest.mark.skipif(shutil.which("ccx") is None, reason="CalculiX (ccx) is not installed")
def test_what_embedding_adds_is_the_same_in_calculix(tmp_path, ply):
    """Plies at 45 degrees, where a plate of free width bows most.

    Two elements across the plate: one C3D20R alone, under-integrated, hardly bows.
    """
    mesh = SpokeMesh(rows=(1, 1, 2, 1, 1, 1), plate_columns=2, bulk_to_shear_ratio=100.0)
    design = replace(small_design(ply, 45.0), mesh=mesh)
    added = []
    for solve in (stiffness_by_ccx(tmp_path), stiffness_by_kernel):
        held, free = (
            solve(replace(design, plate_coupling=coupling))
            for coupling in ("embedded", "conforming")
        )
        added.append(held / free - 1.0)
    assert added[0] > 0.04
    assert added[1] == pytest.approx(added[0], rel=0.15)


def stiffness_by_kernel(design):
    return SpokeModel(design).rest().tangent[0, 0]


def stiffness_by_ccx(folder):
    def solve(design):
        (folder / "spoke.inp").write_text(spoke_deck(design, [0.01]))
        run = subprocess.run(
            ["ccx", "spoke"], cwd=folder, capture_output=True, text=True, check=True
        )
        assert not re.search(r"\*(WARNING|ERROR)", run.stdout)
        return design.plates * total_forces((folder / "spoke.dat").read_text())[-1, 2] / 0.01

    return solve
