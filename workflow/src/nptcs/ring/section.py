"""Cross-section of the ring: its stiffness, and where its surfaces are.

The generalised strains of the ring are, in this order,

    v = (e, κs, κf, s', q, γ, s)

stretch e of the middle between the wires, change of the section's curvature κs and of the faces'
κf, gradient s' of the tread's shear, shear q of the faces, shear γ = ψ + q - θ of the core and
shift s of the tread's surface. The energy per unit of the middle's length is ½ C_ij v_i v_j +
⅙ D_ijk v_i v_j v_k: neo-Hookean rubber, C10 (λ² + 1/λ² - 2) in plane strain, is stiffer in
compression than in tension, and above the contact the tread is compressed by three per cent.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from nptcs.arrays import Array
from nptcs.config.solvers.tyre import TyreGeometry
from nptcs.ring.pressure_waves import FlatRing, foot_squeeze, matched_thickening, missing_drift
from nptcs.ring.rubber import Rubber
from nptcs.ring.section_layers import Depths, assembled, core_under_wires, strip_layers


@dataclass(frozen=True)
class RingSection:
    """Stiffness and dimensions of the ring's cross-section.

    Parameters
    ----------
    radius_mm : float
        R, of the middle between the wires.
    half_distance_mm : float
        c, half the distance between the wires.
    surface_mm : float
        From the outer wires to the tread's surface.
    foot_mm : float
        From the inner wires to the spokes' feet.
    width_mm : float
        Axial width.
    stiffness : array (7, 7)
        C for the strains (e, κs, κf, s', q, γ, s): N, N mm, N mm² as their products require.
    hardening : array (4, 4, 4)
        D for the strains (e, κs, κf, s').
    core : array (6,)
        Pull of the wires on the core's thickness per unit of (e, κs, κf) (N, N mm, N mm), the
        core's compliance (mm²/N), the wires' stiffness (N) and the curvature 1/R (1/mm).
    thickening : array (3,)
        Growth of the tread's thickness per unit of κs and κf (mm²) and of s' (mm).
    compliance_mm_per_mpa : float
        Thinning of tread and band under the pressure of the ground; 0 for incompressible rubber.
    shear_compliance_mm_per_mpa : float
        Movement of the tread's surface per shear of the ground, beyond that of the shape f.
    foot_squeeze : array (2,)
        Compliance of the band's layers under a spoke's foot beyond that of the ring: displacement
        per force (mm/N) and turn per moment (1/(N mm)).
    """

    radius_mm: float
    half_distance_mm: float
    surface_mm: float
    foot_mm: float
    width_mm: float
    stiffness: Array
    hardening: Array
    core: Array
    thickening: Array
    compliance_mm_per_mpa: float
    shear_compliance_mm_per_mpa: float
    foot_squeeze: Array

    @property
    def outer_radius_mm(self) -> float:
        """Radius of the tread's surface."""
        return self.radius_mm + self.half_distance_mm + self.surface_mm


def ring_section(
    tyre: TyreGeometry, band: Rubber, tread: Rubber, row_depth_mm: float, foot_width_mm: float
) -> RingSection:
    """Section of a tyre: two layers of wires in rubber, the tread outside.

    Parameters
    ----------
    tyre : TyreGeometry
    band : Rubber
        Of the shear band with its covers over the wires.
    tread : Rubber
    row_depth_mm : float
        Depth of rubber around each layer of wires that turns with them and does not shear.
    foot_width_mm : float
        Of a spoke's foot along the circumference.

    Raises
    ------
    ValueError
        If the wires' rows fill the band, or the band does not cover its wires.
    """
    inner, outer = tyre.inner_wire_diameter_mm / 2.0, tyre.outer_wire_diameter_mm / 2.0
    radius, half = 0.5 * (inner + outer), 0.5 * (outer - inner)
    cover = 0.5 * tyre.shear_band_thickness_mm - half
    surface = tyre.outer_diameter_mm / 2.0 - outer
    row = row_depth_mm / 2.0
    if not 0.0 <= row < half:
        raise ValueError(
            f"rows {row_depth_mm:g} mm deep fill the space between wires {2.0 * half:g} mm apart"
        )
    if cover <= tyre.wire_diameter_mm / 2.0 or row > cover:
        raise ValueError(
            f"a band {tyre.shear_band_thickness_mm:g} mm thick does not cover its wires, "
            f"{2.0 * half:g} mm apart, with rows {row_depth_mm:g} mm deep"
        )
    if surface <= cover:
        raise ValueError(
            f"the tread's surface, {surface:g} mm outside the wires, lies inside the band's cover "
            f"of {cover:g} mm"
        )
    depths = Depths(half, row, cover, surface)
    # the core under a pressure that fades to the inner wires: from its mean to its outer face
    squeezed = band.through_compliance_per_mpa * (cover + 2.0 / 3.0 * half)
    squeezed += tread.through_compliance_per_mpa * (surface - cover)
    flat, _, flat_thickening = assembled(tyre, band, tread, depths, np.inf)
    width = tyre.tread_width_mm
    flat_ring = FlatRing(flat, flat_thickening, squeezed, width, half, surface)
    strip = strip_layers(tyre, band, tread, depths)
    change = matched_thickening(flat_ring, strip, 2.0 * half + surface)
    stiffness, hardening, thickening = assembled(tyre, band, tread, depths, radius)
    thickening[2] += change
    core = core_under_wires(tyre, band, half - row, half, radius)
    return RingSection(
        radius_mm=radius,
        half_distance_mm=half,
        surface_mm=surface,
        foot_mm=cover,
        width_mm=width,
        stiffness=stiffness,
        hardening=hardening,
        core=core,
        thickening=thickening,
        compliance_mm_per_mpa=squeezed,
        shear_compliance_mm_per_mpa=missing_drift(flat_ring, strip, 2.0 * half + surface),
        foot_squeeze=foot_squeeze(flat_ring, strip, 2.0 * half + surface, foot_width_mm),
    )
