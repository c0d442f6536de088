"""One spoke of an Abaqus deck, solved for small motions by an independent solver.

It takes everything from the deck as `abaqus_deck` reads it: bricks, shells, plies, orientations,
materials, what is embedded, held and moved. Bricks have one pressure (C3D8H), shells are
shear-flexible with one point for the shear (as S4R), their translations are those of the bricks
around them and their rotations are free, as with *EMBEDDED ELEMENT.
"""

from __future__ import annotations

import numpy as np
from scipy.sparse import block_diag, csr_matrix, identity
from scipy.sparse.linalg import splu

GAUSS = 1.0 / np.sqrt(3.0)
BRICK = np.array(
    [
        *[(-1, -1, -1), (1, -1, -1), (1, 1, -1), (-1, 1, -1)],
        *[(-1, -1, 1), (1, -1, 1), (1, 1, 1), (-1, 1, 1)],
    ]
)
QUAD = np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)])


def radial_stiffness(deck, reader, bulk_to_shear=2000.0):
    """N/mm between the rim and the band's foot of spoke 01, moved outwards at rest.

    The rubber's D1 = 0 is approached by a bulk modulus of `bulk_to_shear` times 2 C10.
    """
    spoke, plates = deck.instances["SPOKE-01"].part, deck.instances["PLATES-01"].part
    c10 = float(reader.material(deck, "SPOKE-RUBBER")["HYPERELASTIC"].data[0][0])
    positions = reader.places(spoke)
    bricks = reader.corners(spoke)
    nodes = np.array([spoke.elements[label][1] for label in spoke.elements]) - 1
    rubber = assemble(rubber_matrices(bricks, c10, bulk_to_shear), nodes, 3, len(positions))
    shells = plate_matrix(deck, reader, plates)
    count = len(plates.positions)
    tie = interpolation(bricks, nodes, len(positions), reader.places(plates), reader)
    follow = block_diag([tie, identity(2 * count)]).tocsr()
    whole = (
        follow.T @ shells @ follow
        + block_diag([rubber, csr_matrix((2 * count, 2 * count))]).tocsr()
    )
    held = np.array([n for name, n in deck.resolve("RIM", "node_sets") if name == "SPOKE-01"]) - 1
    ((row, face),) = spoke.surfaces["FOOT"].data
    assert face == "S2"
    outer = [spoke.elements[label][1][4:] for label in spoke.element_sets[row]]
    moved = np.unique(outer) - 1
    free = np.ones(whole.shape[0], dtype=bool)
    for fixed in (held, moved):
        free[(3 * fixed[:, None] + np.arange(3)).ravel()] = False
    motion = np.zeros(whole.shape[0])
    motion[3 * moved + 1] = -1.0  # outwards is down under the wheel's centre
    force = whole @ motion
    motion[free] = splu(whole[free][:, free].tocsc()).solve(-force[free])
    return -float((whole @ motion)[3 * moved + 1].sum())


def assemble(matrices, nodes, per_node, count):
    """Sum element matrices (elements, n, n) into a sparse one."""
    dofs = (nodes[:, :, None] * per_node + np.arange(per_node)).reshape(len(nodes), -1)
    wide = dofs.shape[1]
    rows, columns = np.repeat(dofs, wide, axis=1).ravel(), np.tile(dofs, (1, wide)).ravel()
    size = per_node * count
    return csr_matrix((matrices.ravel(), (rows, columns)), shape=(size, size))


def rubber_matrices(bricks, c10, bulk_to_shear):
    """Stiffness (elements, 24, 24) of eight-node bricks with one pressure each."""
    shear = 2.0 * c10
    matrices = np.zeros((len(bricks), 24, 24))
    volume, dilation = np.zeros(len(bricks)), np.zeros((len(bricks), 24))
    deviatoric = np.diag([2.0, 2.0, 2.0, 1.0, 1.0, 1.0])
    deviatoric[:3, :3] -= 2.0 / 3.0
    for point in BRICK * GAUSS:
        terms = 1.0 + BRICK * point
        x, y, z = terms.T
        slope = BRICK * np.stack([y * z, x * z, x * y], axis=1) / 8.0
        jacobian = np.einsum("enx,nj->exj", bricks, slope)
        weight = np.linalg.det(jacobian)
        gradient = np.einsum("nj,ejx->enx", slope, np.linalg.inv(jacobian))
        strain = np.zeros((len(bricks), 6, 8, 3))
        for i in range(3):
            strain[:, i, :, i] = gradient[..., i]
        for row, (i, j) in enumerate(((0, 1), (1, 2), (0, 2)), 3):
            strain[:, row, :, i], strain[:, row, :, j] = gradient[..., j], gradient[..., i]
        strain = strain.reshape(len(bricks), 6, 24)
        matrices += shear * np.einsum(
            "e,eia,ij,ejb->eab", weight, strain, deviatoric, strain, optimize=True
        )
        volume += weight
        dilation += weight[:, None] * gradient.reshape(len(bricks), 24)
    mean = bulk_to_shear * shear / volume
    return matrices + mean[:, None, None] * dilation[:, :, None] * dilation[:, None, :]


def laminate(deck, reader, layers):
    """Membrane, coupling, bending (3, 3) and shear (2, 2) stiffness of a composite section."""
    total = sum(float(layer[0]) for layer in layers)
    bottom, parts = -total / 2.0, [np.zeros((3, 3)) for _ in range(3)]
    across = np.zeros((2, 2))
    for thickness, _, material, angle, _ in layers:
        data = reader.material(deck, material)["ELASTIC"].data[0]
        e1, e2, nu12, g12, g13, g23 = (float(value) for value in data)
        compliance = np.array(
            [[1.0 / e1, -nu12 / e1, 0.0], [-nu12 / e1, 1.0 / e2, 0.0], [0.0, 0.0, 1.0 / g12]]
        )
        c, s = np.cos(np.radians(float(angle))), np.sin(np.radians(float(angle)))
        # stresses of the section's axes to those of the fibre
        turn = np.array(
            [[c * c, s * s, 2 * c * s], [s * s, c * c, -2 * c * s], [-c * s, c * s, c * c - s * s]]
        )
        stiffness = np.linalg.inv(turn.T @ compliance @ turn)
        top = bottom + float(thickness)
        for power, part in enumerate(parts, 1):
            part += stiffness * (top**power - bottom**power) / power
        spin = np.array([[c, s], [-s, c]])
        across += 5.0 / 6.0 * float(thickness) * spin.T @ np.diag([g13, g23]) @ spin
        bottom = top
    return (*parts, across)


def plate_matrix(deck, reader, part):
    """Stiffness of all shells: three translations of each node, then two rotations of each."""
    count = len(part.positions)
    axes = {block.parameters["NAME"]: block.data[0] for block in part.named("ORIENTATION")}
    rows, columns, values = [], [], []
    for section in part.named("SHELL SECTION"):
        stiffness = laminate(deck, reader, section.data)
        data = np.array(axes[section.parameters["ORIENTATION"]], dtype=float)
        for label in part.element_sets[section.parameters["ELSET"]]:
            nodes = np.array(part.elements[label][1]) - 1
            corners = np.array([part.positions[node + 1] for node in nodes])
            normal = np.cross(corners[1] - corners[0], corners[3] - corners[0])
            normal /= np.linalg.norm(normal)
            first = data[:3] - (data[:3] @ normal) * normal
            first /= np.linalg.norm(first)
            frame = np.stack([first, np.cross(normal, first), normal])
            matrix = shell_matrix(corners @ frame[:2].T, stiffness)
            turn = np.kron(np.eye(4), np.block([[frame, np.zeros((3, 2))],
                                                [np.zeros((2, 3)), np.eye(2)]]))  # fmt: skip
            dofs = np.concatenate(
                [[*(3 * n + np.arange(3)), *(3 * count + 2 * n + np.arange(2))] for n in nodes]
            )
            rows.append(np.repeat(dofs, 20))
            columns.append(np.tile(dofs, 20))
            values.append((turn.T @ matrix @ turn).ravel())
    places = (np.concatenate(rows), np.concatenate(columns))
    return csr_matrix((np.concatenate(values), places), shape=(5 * count, 5 * count))


def shell_matrix(corners, stiffness):
    """Stiffness (20, 20) of a flat four-node shell; u, v, w and the slopes of u and v in z."""
    membrane, coupling, bending, across = stiffness
    matrix = np.zeros((20, 20))
    for point in QUAD * GAUSS:
        stretch, curve, _, area = shell_strains(corners, point)
        matrix += area * (stretch.T @ membrane @ stretch + curve.T @ bending @ curve)
        mixed = area * stretch.T @ coupling @ curve
        matrix += mixed + mixed.T
    _, _, shear, area = shell_strains(corners, np.zeros(2))
    return matrix + 4.0 * area * shear.T @ across @ shear


def shell_strains(corners, point):
    """Membrane strains, curvatures (3, 20), transverse shears (2, 20) and area per weight."""
    terms = 1.0 + QUAD * point
    shape = terms.prod(axis=1) / 4.0
    slope = QUAD * terms[:, ::-1] / 4.0
    jacobian = corners.T @ slope
    dx, dy = (slope @ np.linalg.inv(jacobian)).T
    stretch, curve, shear = np.zeros((3, 4, 5)), np.zeros((3, 4, 5)), np.zeros((2, 4, 5))
    for rows, (i, j) in ((stretch, (0, 1)), (curve, (3, 4))):
        rows[0, :, i], rows[1, :, j] = dx, dy
        rows[2, :, i], rows[2, :, j] = dy, dx
    shear[0, :, 2], shear[1, :, 2] = dx, dy
    shear[0, :, 3], shear[1, :, 4] = shape, shape
    flat = (part.reshape(len(part), 20) for part in (stretch, curve, shear))
    return (*flat, np.linalg.det(jacobian))


def interpolation(bricks, nodes, count, points, reader):
    """Translations of the points from those of the bricks' nodes, a sparse matrix."""
    which, natural = reader.host(bricks, points)
    weights = reader.shape_and_slope(natural)[0]
    rows = 3 * np.repeat(np.arange(len(points)), 8)
    columns = 3 * nodes[which].ravel()
    three = np.arange(3)[:, None]
    places = ((rows + three).ravel(), (columns + three).ravel())
    return csr_matrix((np.tile(weights.ravel(), 3), places), shape=(3 * len(points), 3 * count))
