"""How much softer a band 215 mm wide with free edges is than one in plane strain.

    python benchmarks/fe_axial_freedom.py            # C10 of band and tread 5 MPa
    python benchmarks/fe_axial_freedom.py --half-contact 15 40

Band and tread as a solid ring: elements of nine nodes with a linear pressure in the section
(radius and axis) and Fourier series around the ring, which bricks of 27 nodes tend to as their
number around the ring grows. Small strains; wires are stiff along the circumference only (and
bend); the spokes are even radial springs of table 10's tension stiffness; a smooth pressure cos²
acts on the tread. The stiffness is the load over the displacement that the pressure works on.

The ring is compared with its own plane strain: the same elements without axial displacement, nearly
incompressible and with the ratios κ/2C10 that `axial` could stand for. `ground slips` leaves the
tread free along the axis, `ground sticks` holds it under the pressure: friction lies between. The
last table gives the softness against single waves around the ring.
"""

from __future__ import annotations

import argparse
from functools import cache

import numpy as np
import pandas as pd

from nptcs.arrays import Array, Index
from nptcs.config.solvers.tyre import TyreGeometry
from nptcs.fe.elements.lagrange import gauss, jacobians, line_shape, tensor_shape
from nptcs.fe.tyre.mesh import band_radii

TYRE = TyreGeometry()
PUBLISHED = "raw_data/published/table10_spoke_stiffness.csv"
NEARLY_INCOMPRESSIBLE = 2000.0
RATIOS = (20.0, 10.0, 5.0)
# elements through covers, band and tread, and from the middle of the width to its edge
ROWS = (1, 2, 1, 2)
COLUMNS = 6
HARMONICS = 160


class Section:
    """Mesh of half the ring's section: nodes (radius, axial place), elements, surfaces."""

    def __init__(self, columns: int) -> None:
        inner, outer = band_radii(TYRE)
        wires = TYRE.inner_wire_diameter_mm / 2.0, TYRE.outer_wire_diameter_mm / 2.0
        breaks = (inner, *wires, outer, TYRE.outer_diameter_mm / 2.0)
        radii = np.concatenate(
            [
                np.linspace(low, high, 2 * rows, endpoint=False)
                for low, high, rows in zip(breaks[:-1], breaks[1:], ROWS, strict=True)
            ]
            + [[breaks[-1]]]
        )
        # finer towards the free edge
        edges = TYRE.tread_width_mm / 2.0 * np.sin(np.linspace(0.0, np.pi / 2.0, columns + 1))
        axial = np.sort(np.concatenate([edges, 0.5 * (edges[1:] + edges[:-1])]))
        self.axial = axial
        self.nodes = np.array([(r, z) for r in radii for z in axial])
        wide = len(axial)
        corner = np.arange(0, len(radii) - 1, 2)[:, None] * wide + np.arange(0, wide - 1, 2)
        local = np.arange(3)[:, None] * wide + np.arange(3)
        self.elements: Index = corner.ravel()[:, None] + local.ravel()
        rows = np.arange(len(self.nodes)).reshape(len(radii), wide)
        self.inside, self.outside = rows[0], rows[-1]
        self.wires = [rows[int(np.argmin(np.abs(radii - radius)))] for radius in wires]

    def line_mass(self) -> Array:
        """∫ N Nᵀ dz over half the width, array (axial nodes, axial nodes)."""
        mass = np.zeros((len(self.axial), len(self.axial)))
        points, weights = np.polynomial.legendre.leggauss(3)
        shape, _ = line_shape(2, points)
        for start in range(0, len(self.axial) - 1, 2):
            part = slice(start, start + 3)
            half = (self.axial[start + 2] - self.axial[start]) / 2.0
            mass[part, part] += np.einsum("gn,gm,g->nm", shape, shape, weights * half)
        return mass


@cache
def section(columns: int) -> Section:
    """Return the mesh, made once."""
    return Section(columns)


def rubber(mesh: Section, n: int, c10_mpa: float, ratio: float) -> Array:
    """Stiffness of the rubber against the wave n: u_r, u_z as cos nθ, u_θ as sin nθ."""
    points, weights = gauss((3, 3))
    shape, slope = tensor_shape((2, 2), points)
    corners = mesh.nodes[mesh.elements]
    gradient, area = jacobians(slope, corners)
    radius = np.einsum("gn,en->eg", shape, corners[..., 0])
    weight = area * weights * radius
    count = len(corners)
    # strains rr, θθ, zz, rθ, θz, rz by u_r, u_θ, u_z of the nodes
    by_node = np.zeros((count, len(points), 6, 9, 3))
    over = shape[None] / radius[..., None]
    by_r, by_z = gradient[..., 0], gradient[..., 1]
    by_node[..., 0, :, 0] = by_r
    by_node[..., 1, :, 0], by_node[..., 1, :, 1] = over, n * over
    by_node[..., 2, :, 2] = by_z
    by_node[..., 3, :, 0], by_node[..., 3, :, 1] = -n * over, by_r - over
    by_node[..., 4, :, 1], by_node[..., 4, :, 2] = by_z, -n * over
    by_node[..., 5, :, 0], by_node[..., 5, :, 2] = by_z, by_r
    strain = by_node.reshape(count, len(points), 6, 27)
    shear = 2.0 * c10_mpa
    deviator = shear * np.diag([2.0, 2.0, 2.0, 1.0, 1.0, 1.0])
    deviator[:3, :3] -= 2.0 * shear / 3.0
    stiffness = np.einsum("egsi,st,egtj,eg->eij", strain, deviator, strain, weight)
    modes = np.column_stack([np.ones(len(points)), points])
    growth = np.einsum("egi,gk,eg->eik", strain[..., :3, :].sum(axis=2), modes, weight)
    mass = np.einsum("gk,gl,eg->ekl", modes, modes, weight)
    stiffness += shear * ratio * growth @ np.linalg.solve(mass, growth.swapaxes(1, 2))
    whole = np.zeros((3 * len(mesh.nodes), 3 * len(mesh.nodes)))
    places = (3 * mesh.elements[..., None] + np.arange(3)).reshape(count, -1)
    np.add.at(whole, (places[:, :, None], places[:, None, :]), stiffness)
    return whole


def add_wires_and_spokes(whole: Array, mesh: Section, n: int, spoke_n_per_mm: float) -> None:
    """Add wires that stretch and bend along the circumference, and springs on the inside."""
    mass = mesh.line_mass()
    per_width = TYRE.wire_layers / 2.0 / TYRE.wire_pitch_mm
    area = np.pi / 4.0 * TYRE.wire_diameter_mm**2 * per_width
    inertia = np.pi / 64.0 * TYRE.wire_diameter_mm**4 * per_width
    for row in mesh.wires:
        radius = float(mesh.nodes[row[0], 0])
        stretch, bend = np.array([1.0, n]) / radius, (n**2 - 1.0) / radius**2
        block = TYRE.wire_modulus_mpa * radius * mass
        for i in range(2):
            for j in range(2):
                whole[np.ix_(3 * row + i, 3 * row + j)] += area * stretch[i] * stretch[j] * block
        whole[np.ix_(3 * row, 3 * row)] += inertia * bend**2 * block
    radius = float(mesh.nodes[mesh.inside[0], 0])
    springs = spoke_n_per_mm * TYRE.spoke_count / (2.0 * np.pi * radius * TYRE.tread_width_mm)
    whole[np.ix_(3 * mesh.inside, 3 * mesh.inside)] += springs * radius * mass


def compliance(n: int, c10_mpa: float, ratio: float, spoke_n_per_mm: float, wide: bool) -> Array:
    """Displacements of the tread by loads on it for the wave n.

    Array (1 + axial nodes, 1 + axial nodes): first the mean pressure on the tread, then the axial
    forces at its nodes. In plane strain there is only the first.
    """
    mesh = section(COLUMNS if wide else 1)
    whole = rubber(mesh, n, c10_mpa, ratio)
    add_wires_and_spokes(whole, mesh, n, spoke_n_per_mm)
    held = np.zeros(len(whole), dtype=bool)
    # the middle of the width is a plane of symmetry; the even wave has no u_θ
    held[2::3] = (mesh.nodes[:, 1] == 0.0) if wide else True
    held[1::3] |= n == 0
    loads = np.zeros((len(whole), 1 + (len(mesh.axial) if wide else 0)))
    loads[3 * mesh.outside, 0] = mesh.line_mass().sum(axis=0) / TYRE.tread_width_mm
    if wide:
        loads[3 * mesh.outside + 2, np.arange(1, loads.shape[1])] = 1.0
    free = ~held
    solved = np.linalg.solve(whole[np.ix_(free, free)], loads[free])
    # ∫ cos² nθ dθ
    norm = 2.0 * np.pi if n == 0 else np.pi
    found: Array = loads[free].T @ solved / norm
    return found


def coefficients(half_contact_mm: float) -> Array:
    """∫ q cos nθ dθ of the pressure q = cos² of unit load over the contact."""
    reach = half_contact_mm / (TYRE.outer_diameter_mm / 2.0)
    points, weights = np.polynomial.legendre.leggauss(64)
    theta = reach * points
    share = np.cos(np.pi / 2.0 * points) ** 2 * weights
    share = share / share.sum()
    waves: Array = np.cos(np.arange(HARMONICS + 1)[:, None] * theta) @ share
    return waves


def displacement(
    half_contact_mm: float, c10_mpa: float, ratio: float, spoke: float, wide: bool
) -> tuple[float, float]:
    """Displacement of half the width under half of 1 N, on ground that slips and that sticks."""
    waves = coefficients(half_contact_mm)
    total = sum(
        wave**2 * compliance(n, c10_mpa, ratio, spoke, wide) for n, wave in enumerate(waves)
    )
    slips = float(total[0, 0])
    # the node in the middle of the width is held anyway
    inner = np.arange(2, len(total))
    cross = total[0, inner]
    held = float(cross @ np.linalg.solve(total[np.ix_(inner, inner)], cross)) if wide else 0.0
    return slips, slips - held


def print_stiffness(c10_mpa: float, half_contact_mm: float) -> None:
    """Print the change of the stiffness against plane strain, in %."""
    published = pd.read_csv(PUBLISHED).set_index("spoke_c10_mpa")["tension_stiffness_n_per_mm"]
    print(f"contact {2.0 * half_contact_mm:g} mm long, stiffness against plane strain in %:")
    for spoke_c10 in (1, 3, 5):
        spoke = float(published[spoke_c10])
        plain, _ = displacement(half_contact_mm, c10_mpa, NEARLY_INCOMPRESSIBLE, spoke, False)
        slips, sticks = displacement(half_contact_mm, c10_mpa, NEARLY_INCOMPRESSIBLE, spoke, True)
        parts = [f"ground slips {100.0 * (plain / slips - 1.0):+.2f}"]
        parts.append(f"sticks {100.0 * (plain / sticks - 1.0):+.2f}")
        for ratio in RATIOS:
            softer, _ = displacement(half_contact_mm, c10_mpa, ratio, spoke, False)
            parts.append(f"κ/2C10 {ratio:g}: {100.0 * (plain / softer - 1.0):+.2f}")
        # half of the load on half of the width
        print(f"  S-C {spoke_c10}: {0.5 / plain:7.2f} N/mm; {'; '.join(parts)}", flush=True)


def print_waves(c10_mpa: float) -> None:
    """Print how much softer the wide ring is against single waves, in %."""
    print("single waves of pressure on the tread, S-C 1, stiffness against plane strain in %:")
    published = pd.read_csv(PUBLISHED).set_index("spoke_c10_mpa")["tension_stiffness_n_per_mm"]
    spoke = float(published[1])
    for n in (5, 10, 20, 40, 80, 135):
        plain = compliance(n, c10_mpa, NEARLY_INCOMPRESSIBLE, spoke, False)[0, 0]
        wide = compliance(n, c10_mpa, NEARLY_INCOMPRESSIBLE, spoke, True)[0, 0]
        ten = compliance(n, c10_mpa, 10.0, spoke, False)[0, 0]
        length = 2.0 * np.pi * TYRE.outer_diameter_mm / 2.0 / n
        print(
            f"  {length:6.1f} mm: free edges {100.0 * (plain / wide - 1.0):+.2f}; "
            f"κ/2C10 10 {100.0 * (plain / ten - 1.0):+.2f}"
        )


def main() -> None:
    """Print both tables."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--c10", type=float, default=5.0, help="of band and tread, MPa")
    parser.add_argument(
        "--half-contact", type=float, nargs="+", default=[25.0], help="half length, mm"
    )
    chosen = parser.parse_args()
    for half in chosen.half_contact:
        print_stiffness(chosen.c10, half)
    print_waves(chosen.c10)


if __name__ == "__main__":
    main()
