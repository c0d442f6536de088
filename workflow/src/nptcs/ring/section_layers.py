"""Layers of the ring's cross-section: what each adds to the section's stiffness.

J ε of each layer by the strains (e, κs, κf, s') of `section`, integrated through its thickness.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

import numpy as np

from nptcs.arrays import Array
from nptcs.config.solvers.tyre import TyreGeometry
from nptcs.ring.pressure_waves import RubberLayer, WireSheet
from nptcs.ring.rubber import Rubber

STRAINS = 7
# those that stretch the rubber along the ring
ALONG = 4
POINTS, WEIGHTS = np.polynomial.legendre.leggauss(8)
# of a circular section (Cowper 1966, Poisson's ratio 0.3)
SHEAR_CORRECTION = 0.886


@dataclass(frozen=True)
class Depths:
    """Distances from the wires: half the core, half a row, the band's face and the surface, mm."""

    half: float
    row: float
    cover: float
    surface: float


def assembled(
    tyre: TyreGeometry, band: Rubber, tread: Rubber, depths: Depths, radius: float
) -> tuple[Array, Array, Array]:
    """Give stiffness, hardening and thickening for one shape of the tread's shear.

    An infinite radius is a flat section.
    """
    half, row, cover, surface = depths.half, depths.row, depths.cover, depths.surface
    stiffness, hardening = np.zeros((STRAINS, STRAINS)), np.zeros((ALONG, ALONG, ALONG))
    for sign in (-1.0, 1.0):
        _add_wires(stiffness, tyre, radius, sign * half)
    inside, width = half - row, tyre.tread_width_mm
    layers = [
        _Layer(band, -half, (-cover, row), partial(_face, -half)),
        _Layer(band, 0.0, (-inside, inside), partial(_core, half, row)),
        _Layer(band, half, (-row, row), partial(_face, half)),
        _Layer(band, half, (row, cover), partial(_tread, half, row, surface)),
        _Layer(tread, half, (cover, surface), partial(_tread, half, row, surface)),
    ]
    for layer in layers:
        layer.add(stiffness, hardening, radius, width)
    stiffness[5, 5] += width * band.shear_mpa * 2.0 * half**2 / inside
    thickening = np.zeros(3)
    for layer in layers[3:]:
        z, weight = layer.rule()
        grow = 1.0 + (half + z) / radius
        slope = 2.0 * (surface - z) / (surface - row) ** 2
        shear = width * layer.rubber.shear_mpa
        stiffness[6, 6] += shear * float(np.sum(weight * grow * slope**2))
        thickening -= layer.rubber.contraction * (weight / grow) @ layer.strain(z)[:, 1:]
    return stiffness, hardening, thickening


def strip_layers(
    tyre: TyreGeometry, band: Rubber, tread: Rubber, depths: Depths
) -> list[RubberLayer | WireSheet]:
    """List the layers of the flat section, from the inside to the outside."""
    stretch = _wire_area_mm2(tyre) * tyre.wire_modulus_mpa / tyre.tread_width_mm
    wires = WireSheet(stretch, stretch * tyre.wire_diameter_mm**2 / 16.0, 2.0 * depths.row)
    cover = RubberLayer(band, depths.cover - depths.row)
    return [
        cover,
        wires,
        RubberLayer(band, 2.0 * (depths.half - depths.row)),
        wires,
        cover,
        RubberLayer(tread, depths.surface - depths.cover),
    ]


@dataclass(frozen=True)
class _Layer:
    """A layer of rubber: z from `centre` between limits, J ε by the strains (e, κs, κf, s')."""

    rubber: Rubber
    centre: float
    limits: tuple[float, float]
    strain: Callable[[Array], Array]

    def rule(self) -> tuple[Array, Array]:
        """Points z and weights across the layer."""
        low, high = self.limits
        return 0.5 * (low + high) + 0.5 * (high - low) * POINTS, 0.5 * (high - low) * WEIGHTS

    def add(self, stiffness: Array, hardening: Array, radius: float, width: float) -> None:
        """Add ½ E b ∫ (ε² - ε³) J dz."""
        z, weight = self.rule()
        strain = self.strain(z)
        grow = 1.0 + (self.centre + z) / radius
        scaled = width * self.rubber.along_mpa * weight / grow
        stiffness[:ALONG, :ALONG] += np.einsum("z,zi,zj->ij", scaled, strain, strain)
        hardening += np.einsum("z,zi,zj,zk->ijk", -3.0 * scaled / grow, strain, strain, strain)


def _face(face: float, z: Array) -> Array:
    """J ε of the wires and rows at ±c, z from the wires' axis: e - (±c) κs - z κf."""
    one = np.ones_like(z)
    return np.stack([one, -face * one, -z, 0.0 * z], axis=1)


def _core(half: float, row: float, z: Array) -> Array:
    """J ε of the core, z from its middle: e - z (c κs - (t_r/2) κf)/(c - t_r/2)."""
    inside = half - row
    return np.stack([np.ones_like(z), -z * half / inside, z * row / inside, 0.0 * z], axis=1)


def _tread(half: float, row: float, surface: float, z: Array) -> Array:
    """J ε of cover and tread, z from the wires' axis: e - c κs - z κf + f s'."""
    level = (surface - z) / (surface - row)
    one = np.ones_like(z)
    return np.stack([one, -half * one, -z, 1.0 - level**2], axis=1)


def _add_wires(stiffness: Array, tyre: TyreGeometry, radius: float, face: float) -> None:
    """Add a layer of wires as two fibres at a quarter of the diameter from its axis.

    The two fibres have the bending stiffness of the round wires.

    The wires' transverse shear stiffness holds the faces square to them.
    """
    area = _wire_area_mm2(tyre)
    z = np.array([-0.25, 0.25]) * tyre.wire_diameter_mm
    strain = _face(face, z)
    scaled = 0.5 * area * tyre.wire_modulus_mpa / (1.0 + (face + z) / radius)
    stiffness[:ALONG, :ALONG] += np.einsum("z,zi,zj->ij", scaled, strain, strain)
    shear = SHEAR_CORRECTION * tyre.wire_modulus_mpa / 2.0 / (1.0 + tyre.wire_poisson_ratio)
    stiffness[4, 4] += shear * area


def core_under_wires(
    tyre: TyreGeometry, band: Rubber, inside: float, half: float, radius: float
) -> Array:
    """Give the wires' pull on the core by (e, κs, κf), its compliance, their stiffness and 1/R.

    The core is 2 `inside` deep and does not move along the ring as it is squeezed; each face moves
    by δ: ½ δ²/a with a = inside/(2 b (κ + 4G/3)).
    """
    area = _wire_area_mm2(tyre)
    z = np.array([-0.25, 0.25]) * tyre.wire_diameter_mm
    pull, stiffness = np.zeros(ALONG), 0.0
    for sign in (-1.0, 1.0):
        scaled = 0.5 * area * tyre.wire_modulus_mpa / (1.0 + (sign * half + z) / radius)
        pull += sign * scaled @ _face(sign * half, z)
        stiffness += float(np.sum(scaled))
    soft = inside * band.through_compliance_per_mpa / (2.0 * tyre.tread_width_mm)
    return np.array([*pull[:3], soft, stiffness, 1.0 / radius])


def _wire_area_mm2(tyre: TyreGeometry) -> float:
    """Area of all wires on one side of the core."""
    one = np.pi / 4.0 * tyre.wire_diameter_mm**2
    return float(one * tyre.tread_width_mm / tyre.wire_pitch_mm * tyre.wire_layers / 2.0)
