"""A tyre as a ring: its section, nodes and spokes, and the kernel that computes with them."""

from __future__ import annotations

from dataclasses import dataclass
from types import ModuleType

import numpy as np

from nptcs.arrays import Array
from nptcs.config.solvers.fe import GroundContact
from nptcs.config.solvers.ring import RingOptions
from nptcs.config.solvers.tyre import TyreGeometry
from nptcs.fe.spoke.energy_table import SpokeEnergyTable
from nptcs.ring.feet import WideFeet, wide_feet
from nptcs.ring.kernel import numpy_kernel
from nptcs.ring.kernel.compiled import HAS_NUMBA, Kernel
from nptcs.ring.kernel.elementwise import band, ground, places
from nptcs.ring.kernel.numpy_kernel import element_variables
from nptcs.ring.kernel.numpy_spokes import spoke_states
from nptcs.ring.kernel.spokes import SpokePolynomial
from nptcs.ring.kernel.system import Ring
from nptcs.ring.nodes import RingNodes, ring_nodes
from nptcs.ring.rubber import Rubber
from nptcs.ring.section import RingSection, ring_section

HEIGHT_TOLERANCE = 0.005


@dataclass(frozen=True)
class RingTyre:
    """A tyre that can be loaded.

    Parameters
    ----------
    section : RingSection
    nodes : RingNodes
    spokes : SpokePolynomial
    contact : GroundContact
    ring : Ring
        The same data as arrays.
    kernel : module
        `numpy_kernel` or `numba_kernel`; both give the same numbers up to rounding.
    """

    section: RingSection
    nodes: RingNodes
    spokes: SpokePolynomial
    contact: GroundContact
    ring: Ring
    kernel: ModuleType

    def neutral_line(self, u: Array) -> tuple[Array, Array]:
        """Displacement (nodes,) of the middle between the wires, outward and along +θ, mm."""
        sin, cos = np.sin(self.nodes.theta), np.cos(self.nodes.theta)
        return u[:, 0] * sin - u[:, 1] * cos, u[:, 0] * cos + u[:, 1] * sin

    def surface(self, u: Array) -> tuple[Array, Array]:
        """Place (x, y) of the tread's surface over each element's middle, mm."""
        mean, difference = element_variables(self.ring, u)
        x, y, _, _ = ground.surface_point(
            self.ring.dimensions, self.nodes.middle, self.nodes.length_mm, mean, difference
        )
        return x, y

    def areas_mm2(self) -> Array:
        """Area of the tread's surface over each element."""
        areas: Array = self.ring.dimensions[places.AREA_PER_LENGTH] * self.nodes.length_mm
        return areas

    def traction(self, u: Array, rise_mm: float, anchor: Array) -> tuple[Array, Array, Array]:
        """Place x (mm), pressure and shear (MPa) of the ground under each element."""
        x, y = self.surface(u)
        depth = rise_mm - self.section.outer_radius_mm - y
        pressure, _, shear, _, _ = ground.traction(self.ring.dimensions, depth, x - anchor)
        return x, pressure, shear

    def anchors(self, u: Array, rise_mm: float, anchor: Array) -> Array:
        """Place (nodes,) at which each element's surface rests after a converged state.

        Off the ground this is the surface's own place.
        """
        placed: Array = self.kernel.anchors(self.ring, u, rise_mm, anchor)
        return placed

    def spoke_motion(self, u: Array) -> Array:
        """(u_r, u_θ, φ) of each spoke's foot, array (spokes, 3)."""
        return spoke_states(self.ring, u).motion.T

    def energy(self, u: Array) -> dict[str, float]:
        """Energy of band (with wires and tread) and spokes (with the band's squeeze), N mm."""
        mean, difference = element_variables(self.ring, u)
        elements = band.energy(
            self.ring.stiffness,
            self.ring.hardening,
            self.ring.core,
            self.nodes.middle,
            self.nodes.length_mm,
            mean,
            difference,
        )
        spokes = spoke_states(self.ring, u)
        return {"band": float(np.sum(elements)), "spokes": float(np.sum(spokes.energy))}


def ring_tyre(
    tyre: TyreGeometry,
    table: SpokeEnergyTable,
    band_c10_mpa: float,
    options: RingOptions,
    tread_c10_mpa: float | None = None,
    spoke_factor: float = 1.0,
    kernel: Kernel | None = None,
) -> RingTyre:
    """Build the ring of a tyre.

    Parameters
    ----------
    tyre : TyreGeometry
    table : SpokeEnergyTable
        Energy of one whole spoke.
    band_c10_mpa : float
        Rubber of the shear band.
    options : RingOptions
    tread_c10_mpa : float, optional
        Rubber of the tread; the band's if it is not given.
    spoke_factor : float
        Multiplies the spokes' energy.
    kernel : {"numpy", "numba"}, optional
        numba if it is installed.

    Raises
    ------
    ValueError
        If the dimensions contradict each other (see `ring_section`), or the table's spokes do not
        fit between rim and band.
    """
    ratio = options.band_bulk_to_shear()
    tread = band_c10_mpa if tread_c10_mpa is None else tread_c10_mpa
    section = ring_section(
        tyre,
        Rubber(band_c10_mpa, ratio),
        Rubber(tread, ratio),
        options.wire_row_mm,
        options.foot_width_mm(),
    )
    _check_spokes(tyre, section, table)
    nodes = ring_nodes(options.mesh, section, tyre.spoke_count)
    inner = section.radius_mm - section.half_distance_mm - section.foot_mm
    feet = wide_feet(nodes, inner, options.foot_width_mm())
    spokes = SpokePolynomial.of_table(table, spoke_factor)
    return RingTyre(
        section,
        nodes,
        spokes,
        options.contact,
        _arrays(section, nodes, feet, spokes, options.contact),
        _kernel(kernel),
    )


def _check_spokes(tyre: TyreGeometry, section: RingSection, table: SpokeEnergyTable) -> None:
    """Refuse spokes that do not reach from the rim to the band."""
    inner = section.radius_mm - section.half_distance_mm - section.foot_mm
    room = inner - tyre.rim_diameter_mm / 2.0
    if abs(room - table.height_mm) > HEIGHT_TOLERANCE * table.height_mm:
        raise ValueError(
            f"the spokes of this table are {table.height_mm:g} mm high, but the distance between "
            f"rim and band is {room:g} mm"
        )


def _kernel(name: Kernel | None) -> ModuleType:
    if name == "numpy" or (name is None and not HAS_NUMBA):
        return numpy_kernel
    from nptcs.ring.kernel import numba_kernel

    return numba_kernel


def _arrays(
    section: RingSection,
    nodes: RingNodes,
    feet: WideFeet,
    spokes: SpokePolynomial,
    contact: GroundContact,
) -> Ring:
    w = np.zeros(places.DIMENSIONS)
    w[places.HALF] = section.half_distance_mm
    w[places.SURFACE] = section.surface_mm
    w[places.FOOT] = section.foot_mm
    w[places.OUTER] = section.outer_radius_mm
    # an element's surface is longer than its chord by the ratio of the radii
    w[places.AREA_PER_LENGTH] = section.width_mm * section.outer_radius_mm / section.radius_mm
    w[places.GROW_SECTION : places.GROW_SHEAR + 1] = section.thickening
    w[places.STIFF] = contact.penalty_mpa_per_mm
    w[places.SMOOTH] = contact.smoothing_mm
    # the tread's own compliance is in series with that of the ground
    slip = 1.0 / contact.tangential_mpa_per_mm + section.shear_compliance_mm_per_mpa
    w[places.SLIP_STIFF] = 1.0 / slip
    w[places.FRICTION] = contact.friction
    w[places.COMPLIANCE] = section.compliance_mm_per_mpa
    return Ring(
        stiffness=section.stiffness,
        hardening=section.hardening,
        core=section.core,
        dimensions=w,
        theta=nodes.theta,
        middle=nodes.middle,
        length_mm=nodes.length_mm,
        feet=nodes.feet,
        wide=feet,
        squeeze=section.foot_squeeze,
        height_mm=spokes.height_mm,
        straight_mm=spokes.straight_mm,
        narrowing=spokes.narrowing,
        low=spokes.low,
        high=spokes.high,
        coefficients=spokes.coefficients,
        sides=spokes.sides,
    )
