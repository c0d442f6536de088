"""Input decks of one spoke for CalculiX, and reading its results.

CalculiX ignores ``*EMBEDDED ELEMENT`` and ``*REBAR LAYER`` with a warning only, so the plies are
meshed, at their true thickness, with one C3D20R brick each through the thickness.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from typing import assert_never

import numpy as np

from nptcs.arrays import Array, Index
from nptcs.fe.spoke.mesh import axial_grid, section_grid
from nptcs.fe.spoke.period import SpokeDesign

# corners, then edges, of a C3D20 brick as places (0, 1, 2) along x, y, z
BRICK = np.array(
    [
        *[(0, 0, 0), (2, 0, 0), (2, 2, 0), (0, 2, 0), (0, 0, 2), (2, 0, 2), (2, 2, 2), (0, 2, 2)],
        *[(1, 0, 0), (2, 1, 0), (1, 2, 0), (0, 1, 0), (1, 0, 2), (2, 1, 2), (1, 2, 2), (0, 1, 2)],
        *[(0, 0, 1), (2, 0, 1), (2, 2, 1), (0, 2, 1)],
    ]
)


# the errors that CalculiX 2.20 prints when Newton's method does not converge
NO_CONVERGENCE = (
    "increment size smaller than minimum",
    "too many cutbacks",
    "too many iterations needed",
    "solution seems to diverge",
    "max. # of increments reached",
)


def true_thickness(design: SpokeDesign) -> SpokeDesign:
    """Return the design with a plate layer as thick as the plate, which meshed plies need."""
    section = design.geometry.model_dump() | {"plate_layer_mm": design.thickness_mm}
    return replace(design, geometry=type(design.geometry)(**section))


@dataclass(frozen=True)
class BrickMesh:
    """Twenty-node bricks of one period with two plies; node numbers from 1.

    Parameters
    ----------
    positions : dict of int to array (3,)
    sets : dict of str to array (elements, 20)
        ``RUBBER``, and ``LOWER_1``, ``LOWER_2``, ``UPPER_1``, ``UPPER_2`` by leg and ply.
    bottom, top : arrays
        Node numbers on the rim and the band.
    pairs : array (pairs, 2)
        Node on the far axial plane and the node that it must follow.
    between : dict of int to tuple (node, node, float)
        For each node between the plies and inside a plate's width: the two nodes on the plate's
        edges at the same height, and the node's place from the first (0) to the second (1).
    """

    positions: dict[int, Array]
    sets: dict[str, Index]
    bottom: Index
    top: Index
    pairs: Index
    between: dict[int, tuple[int, int, float]]


def brick_mesh(design: SpokeDesign) -> BrickMesh:
    """Mesh one period of a spoke with 20-node bricks, each ply its own layer."""
    rows, x, has_plate = section_grid(design.geometry, design.mesh)
    y = axial_grid(design.mesh, design.pitch_mm, design.plate_width_mm)
    inner = 2 * design.mesh.columns
    split = np.array([0.25, 0.5, 0.75])
    between = x[:, [inner]] + (x[:, [inner + 1]] - x[:, [inner]]) * split
    x = np.concatenate([x[:, : inner + 1], between, x[:, inner + 1 :]], axis=1)
    shape = (x.shape[1], len(y), len(rows))
    sets: dict[str, list[Index]] = {}
    for r in range(len(has_plate)):
        for s in range(len(y) // 2):
            for c in range((shape[0] - 1) // 2):
                ply = c - inner // 2
                plated = has_plate[r] and s < design.mesh.plate_columns and ply in (0, 1)
                leg = "LOWER" if r < len(has_plate) // 2 else "UPPER"
                name = f"{leg}_{ply + 1}" if plated else "RUBBER"
                places = BRICK + 2 * np.array([c, s, r])
                sets.setdefault(name, []).append(np.ravel_multi_index(places.T, shape) + 1)
    blocks = {name: np.array(nodes) for name, nodes in sets.items()}
    used = np.unique(np.concatenate([block.ravel() for block in blocks.values()]))
    column, plane, row = np.unravel_index(used - 1, shape)
    positions = np.stack([x[row, column], y[plane], rows[row]], axis=1)
    last_row = len(rows) - 1
    far = used[(plane == len(y) - 1) & (row > 0) & (row < last_row)]
    step = (len(y) - 1) * len(rows)
    edge = 2 * design.mesh.plate_columns
    plated_rows = np.unique(2 * np.flatnonzero(has_plate)[:, None] + np.arange(3))
    inside = (column == inner + 2) & (plane > 0) & (plane < edge) & np.isin(row, plated_rows)
    between = {
        int(node): (int(node - s * len(rows)), int(node + (edge - s) * len(rows)), s / edge)
        for node, s in zip(used[inside], plane[inside], strict=True)
    }
    return BrickMesh(
        positions=dict(zip(used.tolist(), positions, strict=True)),
        sets=blocks,
        bottom=used[row == 0],
        top=used[row == last_row],
        pairs=np.stack([far, far - step], axis=1),
        between=between,
    )


def spoke_deck(design: SpokeDesign, u_r_mm: Sequence[float]) -> str:
    """Write a complete CalculiX deck: one period, a step for each radial displacement.

    Parameters
    ----------
    design : SpokeDesign
        Its plate layer must be as thick as the plate (`true_thickness`).
    u_r_mm : sequence of float
        Radial displacement of the band at the end of each step, mm.

    Raises
    ------
    ValueError
        If the plate's layer is not as thick as the plate.
    """
    if not np.isclose(design.geometry.plate_layer_mm, design.thickness_mm):
        raise ValueError("meshed plies need plate_layer_mm equal to the plate's thickness")
    return deck(design, brick_mesh(design), "C3D20R", u_r_mm)


def deck(design: SpokeDesign, mesh: BrickMesh, element: str, u_r_mm: Sequence[float]) -> str:
    """Write the deck of a mesh of bricks of one CalculiX element type."""
    lines = [
        "** One axial period of a spoke of a non-pneumatic tyre. Units: N, mm, MPa.",
        f"** The whole spoke carries {design.plates} times the forces printed here.",
        "** x along the circumference, y along the axis (periodic), z along the radius.",
        "*NODE, NSET=NALL",
    ]
    lines += [f"{n}, " + ", ".join(f"{v:.9g}" for v in p) for n, p in mesh.positions.items()]
    number = 1
    for name, nodes in mesh.sets.items():
        lines.append(f"*ELEMENT, TYPE={element}, ELSET={name}")
        for brick in nodes.tolist():
            text = ", ".join(map(str, [number, *brick])).split(" ")
            lines += [" ".join(text[i : i + 11]) for i in range(0, len(text), 11)]
            number += 1
    lines += [*_node_set("NBOTTOM", mesh.bottom), *_node_set("NTOP", mesh.top)]
    lines += _materials(design, sorted(set(mesh.sets) - {"RUBBER"}))
    lines.append("** the period repeats along the axis")
    for far, near in mesh.pairs:
        for axis in (1, 2, 3):
            lines += ["*EQUATION", "2", f"{far}, {axis}, 1., {near}, {axis}, -1."]
    lines += _plate_coupling(design, mesh)
    lines += ["*BOUNDARY", "NBOTTOM, 1, 3", "NTOP, 1, 2"]
    for u_r in u_r_mm:
        lines += ["*STEP, NLGEOM, INC=500", "*STATIC", "0.25, 1., 1e-4, 0.5"]
        lines += ["*BOUNDARY", f"NTOP, 3, 3, {u_r:.9g}"]
        lines += ["*NODE PRINT, NSET=NTOP, TOTALS=ONLY, FREQUENCY=1000", "RF", "*END STEP"]
    return "\n".join(lines) + "\n"


def _plate_coupling(design: SpokeDesign, mesh: BrickMesh) -> list[str]:
    """Equations that hold the plates' mid-surface straight if the design couples it that way."""
    match design.plate_coupling:
        case "conforming":
            return []
        case "embedded":
            lines = ["** the plates' mid-surface stays straight across their width"]
        case _:
            assert_never(design.plate_coupling)
    for node, (first, last, part) in mesh.between.items():
        for axis in (1, 2, 3):
            ends = f"{first}, {axis}, {part - 1.0:.9g}, {last}, {axis}, {-part:.9g}"
            lines += ["*EQUATION", "3", f"{node}, {axis}, 1., {ends}"]
    return lines


def _node_set(name: str, nodes: Iterable[int]) -> list[str]:
    return [f"*NSET, NSET={name}", *[f"{node}," for node in nodes]]


def _materials(design: SpokeDesign, plies: Sequence[str]) -> list[str]:
    bulk = design.mesh.bulk_to_shear_ratio * 2.0 * design.c10_mpa
    ply = design.ply
    constants = [ply[n] for n in ("e1_mpa", "e2_mpa", "e3_mpa", "nu12", "nu13", "nu23")]
    constants += [ply["g12_mpa"], ply["g13_mpa"]]
    lines = [
        "*MATERIAL, NAME=MRUBBER",
        "*HYPERELASTIC, NEO HOOKE",
        f"{design.c10_mpa:.9g}, {2.0 / bulk:.9g}",
        "*SOLID SECTION, ELSET=RUBBER, MATERIAL=MRUBBER",
        "*MATERIAL, NAME=MPLY",
        "*ELASTIC, TYPE=ENGINEERING CONSTANTS",
        ", ".join(f"{value:.9g}" for value in constants) + ",",
        f"{ply['g23_mpa']:.9g}",
    ]
    slope = np.radians(design.geometry.leg_angle_deg)
    for name in plies:
        leg, number = name.split("_")
        lean = -slope if leg == "LOWER" else slope
        along, across = np.array([np.sin(lean), 0.0, np.cos(lean)]), np.array([0.0, 1.0, 0.0])
        angle = np.radians(design.angle_deg if number == "1" else -design.angle_deg)
        fibre = np.cos(angle) * along + np.sin(angle) * across
        normal = np.cos(angle) * across - np.sin(angle) * along
        lines += [
            f"*ORIENTATION, NAME=O_{name}, SYSTEM=RECTANGULAR",
            ", ".join(f"{value:.12g}" for value in (*fibre, *normal)),
            f"*SOLID SECTION, ELSET={name}, MATERIAL=MPLY, ORIENTATION=O_{name}",
        ]
    return lines


def total_forces(dat_text: str) -> Array:
    """Read the printed total forces of the band, array (steps, 3), N for one period.

    There is one row per completed step; CalculiX leaves the file empty if none was.
    """
    number = r"([-+0-9.Ee]+)"
    pattern = rf"total force \(fx,fy,fz\) for set NTOP.*\n\s*\n\s*{number}\s+{number}\s+{number}"
    return np.array(re.findall(pattern, dat_text), dtype=float).reshape(-1, 3)


def complaints(output: str) -> str:
    """Return the warnings and errors about the model in what CalculiX printed, or an empty text.

    CalculiX ignores keywords that it does not know with a warning and exit code 0, so a warning
    means that a different model was solved. A failure to converge is not about the model.
    """
    lines = [line.strip() for line in output.splitlines()]
    starts = [
        i
        for i, line in enumerate(lines)
        if re.match(r"\*(WARNING|ERROR)", line) and not any(end in line for end in NO_CONVERGENCE)
    ]
    return " | ".join(" ".join(lines[i : i + 3]) for i in starts)
