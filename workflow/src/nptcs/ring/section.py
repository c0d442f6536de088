"""Cross-section of the ring: what its strains cost, and where its surfaces lie.

The generalised strains of the ring are, in this order,

    v = (e, κs, κf, s', q, γ, s)

stretch e of the middle between the wires, change of the section's curvature κs and of the faces'
κf, gradient s' of the tread's shear, shear q of the faces, shear γ = ψ - θ of the core and shift s
of the tread's surface. The energy per unit of the middle's length is ½ vᵀ C v.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from nptcs.arrays import Array
from nptcs.config.tyre import TyreGeometry

STRAINS = 7
POINTS = 8
# of a circular section (Cowper 1966, Poisson's ratio 0.3)
SHEAR_CORRECTION = 0.886


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
        C for the strains (e, κs, κf, s', q, γ, s): N, N mm, N mm² as their products ask.
    thickening : array (3,)
        Growth of the tread's thickness by κs and κf (mm²) and by s' (mm).
    compliance_mm_per_mpa : float
        Thinning of tread and band under the pressure of the ground; 0 for incompressible rubber.
    """

    radius_mm: float
    half_distance_mm: float
    surface_mm: float
    foot_mm: float
    width_mm: float
    stiffness: Array
    thickening: Array
    compliance_mm_per_mpa: float

    @property
    def outer_radius_mm(self) -> float:
        """Radius of the tread's surface."""
        return self.radius_mm + self.half_distance_mm + self.surface_mm


@dataclass(frozen=True)
class Rubber:
    """A rubber in plane strain, small strains: shear modulus and κ/G.

    Parameters
    ----------
    c10_mpa : float
        Neo-Hooke; the shear modulus is 2 C10.
    bulk_to_shear_ratio : float
        κ/2C10; infinite is incompressible.
    """

    c10_mpa: float
    bulk_to_shear_ratio: float

    @property
    def shear_mpa(self) -> float:
        """Shear modulus G."""
        return 2.0 * self.c10_mpa

    @property
    def along_mpa(self) -> float:
        """Modulus along the ring: 4 G (κ + G/3)/(κ + 4G/3), which is 8 C10 if incompressible."""
        inverse = 1.0 / self.bulk_to_shear_ratio
        return 4.0 * self.shear_mpa * (1.0 + inverse / 3.0) / (1.0 + 4.0 * inverse / 3.0)

    @property
    def contraction(self) -> float:
        """Thickness lost by a stretch along the ring: (κ - 2G/3)/(κ + 4G/3), 1 if incompressible."""
        inverse = 1.0 / self.bulk_to_shear_ratio
        return (1.0 - 2.0 * inverse / 3.0) / (1.0 + 4.0 * inverse / 3.0)

    @property
    def through_compliance_per_mpa(self) -> float:
        """Strain through the thickness by a pressure where nothing moves along: 1/(κ + 4G/3)."""
        inverse = 1.0 / self.bulk_to_shear_ratio
        return inverse / (self.shear_mpa * (1.0 + 4.0 * inverse / 3.0))


def ring_section(
    tyre: TyreGeometry, band: Rubber, tread: Rubber, row_depth_mm: float
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
        raise ValueError(f"rows of {row_depth_mm:g} mm fill wires {2.0 * half:g} mm apart")
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
    width = tyre.tread_width_mm
    stiffness = np.zeros((STRAINS, STRAINS))
    for sign in (-1.0, 1.0):
        _add_wires(stiffness, tyre, radius, sign * half)
    along, shear = width * band.along_mpa, width * band.shear_mpa
    for sign in (-1.0, 1.0):
        face = sign * half
        row_limits = (-row, row) if sign > 0 else (-cover, row)
        _add_rubber(stiffness, along, radius, face, row_limits, lambda z, face=face: _face(face, z))
    inside = half - row
    _add_rubber(
        stiffness, along, radius, 0.0, (-inside, inside), lambda z: _core(half, row, inside, z)
    )
    stiffness[5, 5] += shear * 2.0 * half**2 / inside
    thickening = np.zeros(3)
    depth = surface - row
    for rubber, limits in ((band, (row, cover)), (tread, (cover, surface))):
        z, weight = _rule(limits)
        level = 1.0 - (z - row) / depth
        shape, slope = 1.0 - level**2, 2.0 * level / depth
        grow = 1.0 + (half + z) / radius
        strain = np.zeros((len(z), STRAINS))
        strain[:, :4] = np.stack([np.ones_like(z), -half + 0.0 * z, -z, shape], axis=1)
        scaled = width * rubber.along_mpa * weight / grow
        stiffness += np.einsum("z,zi,zj->ij", scaled, strain, strain)
        stiffness[6, 6] += width * rubber.shear_mpa * float(np.sum(weight * grow * slope**2))
        thickening -= rubber.contraction * np.einsum("z,zi->i", weight / grow, strain[:, 1:4])
    squeezed = band.through_compliance_per_mpa * (cover + 0.75 * half)
    squeezed += tread.through_compliance_per_mpa * (surface - cover)
    return RingSection(radius, half, surface, cover, width, stiffness, thickening, squeezed)


def _rule(limits: tuple[float, float]) -> tuple[Array, Array]:
    points, weights = np.polynomial.legendre.leggauss(POINTS)
    low, high = limits
    return 0.5 * (low + high) + 0.5 * (high - low) * points, 0.5 * (high - low) * weights


def _face(face: float, z: Array) -> Array:
    """J ε of the wires and rows at ±c, z from the wires' axis: e - (±c) κs - z κf."""
    return np.stack([np.ones_like(z), -face + 0.0 * z, -z], axis=1)


def _core(half: float, row: float, inside: float, z: Array) -> Array:
    """J ε of the core, z from its middle: e - z (c κs - (t_r/2) κf)/(c - t_r/2)."""
    return np.stack([np.ones_like(z), -z * half / inside, z * row / inside], axis=1)


def _add_rubber(stiffness, modulus_n_per_mm, radius, centre, limits, strain_of):
    """Add ∫ E b (J ε)²/J dz of a layer of rubber."""
    z, weight = _rule(limits)
    strain = strain_of(z)
    scaled = modulus_n_per_mm * weight / (1.0 + (centre + z) / radius)
    stiffness[:3, :3] += np.einsum("z,zi,zj->ij", scaled, strain, strain)


def _add_wires(stiffness: Array, tyre: TyreGeometry, radius: float, face: float) -> None:
    """Add a layer of wires: two fibres at a quarter of the diameter from its axis bend as they do.

    Their transverse shear stiffness holds the faces square to them.
    """
    area = np.pi / 4.0 * tyre.wire_diameter_mm**2
    area *= tyre.tread_width_mm / tyre.wire_pitch_mm * tyre.wire_layers / 2.0
    z = np.array([-0.25, 0.25]) * tyre.wire_diameter_mm
    strain = _face(face, z)
    scaled = 0.5 * area * tyre.wire_modulus_mpa / (1.0 + (face + z) / radius)
    stiffness[:3, :3] += np.einsum("z,zi,zj->ij", scaled, strain, strain)
    shear = SHEAR_CORRECTION * tyre.wire_modulus_mpa / 2.0 / (1.0 + tyre.wire_poisson_ratio)
    stiffness[4, 4] += shear * area
