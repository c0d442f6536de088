"""The ring of the load-bearing model: its section constants and where they come from.

Two sections are known. *Sandwich* is the physical one: steel layers at their distance from the
middle of a rubber band of the thickness of table 3. *Printed* repeats the numbers of the paper's
section 3.3.3, whose moment of inertia is that about the wrong axis; it is kept so that both can
be shown side by side.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import pi
from typing import Literal, get_args

from nptcs.config.tyre import TyreGeometry
from nptcs.lca.checks import require_positive

SectionKind = Literal["sandwich", "printed"]
SECTION_KINDS: tuple[str, ...] = get_args(SectionKind)


@dataclass(frozen=True)
class RingSection:
    """Stiffness of the shear band, taken as a curved Timoshenko beam.

    Parameters
    ----------
    axial_stiffness_n : float
        EA, force for a tangential strain of one (N).
    shear_stiffness_n : float
        GA, shear force for a shear strain of one (N).
    bending_stiffness_n_mm2 : float
        EI, moment for a curvature of one per millimetre (N mm²).
    radius_mm : float
        Mean radius R (mm).
    width_mm : float
        Axial width b on which the contact pressure acts (mm).

    Raises
    ------
    InputError
        A value is not a positive finite number.
    """

    axial_stiffness_n: float
    shear_stiffness_n: float
    bending_stiffness_n_mm2: float
    radius_mm: float
    width_mm: float

    def __post_init__(self) -> None:
        for name, value in vars(self).items():
            require_positive(name, value)

    @classmethod
    def from_tyre(
        cls, tyre: TyreGeometry, c10_mpa: float, kind: SectionKind = "sandwich"
    ) -> RingSection:
        """Return the section of a tyre whose band rubber has the constant C10.

        Parameters
        ----------
        tyre : TyreGeometry
            Dimensions, wires and their modulus.
        c10_mpa : float
            Neo-Hookean constant of the band's rubber (MPa); E = 6 C10 and G = 2 C10
            (equations 18 and 19 of the paper).
        kind : {"sandwich", "printed"}
            The physical section or that of the paper's section 3.3.3.
        """
        require_positive("shear_band_c10_mpa", c10_mpa)
        build = {"sandwich": _sandwich, "printed": _printed}[kind]
        ea, ga, ei = build(tyre, c10_mpa)
        return cls(ea, ga, ei, tyre.band_radius_mm, tyre.tread_width_mm)


def wire_area_mm2(tyre: TyreGeometry) -> float:
    """Return the cross-section of all wire layers together (mm²)."""
    wires_per_layer = tyre.tread_width_mm / tyre.wire_pitch_mm
    return tyre.wire_layers * wires_per_layer * pi / 4 * tyre.wire_diameter_mm**2


def _wire_distance_mm(tyre: TyreGeometry) -> float:
    """Return the radial distance between the inner and the outer wire layers (mm)."""
    return (tyre.outer_wire_diameter_mm - tyre.inner_wire_diameter_mm) / 2


def _sandwich(tyre: TyreGeometry, c10_mpa: float) -> tuple[float, float, float]:
    """EA, GA, EI with the wires as the skins and the whole rubber thickness as the core."""
    steel = tyre.wire_modulus_mpa * wire_area_mm2(tyre)
    area = tyre.tread_width_mm * tyre.shear_band_thickness_mm
    offset = _wire_distance_mm(tyre) / 2
    return steel + 6 * c10_mpa * area, 2 * c10_mpa * area, steel * offset**2


def _printed(tyre: TyreGeometry, c10_mpa: float) -> tuple[float, float, float]:
    """EA, GA, EI of section 3.3.3: A = b h and I = h b³/12, h the distance of the layers."""
    height = _wire_distance_mm(tyre)
    area = tyre.tread_width_mm * height
    inertia = height * tyre.tread_width_mm**3 / 12
    ea = tyre.wire_modulus_mpa * wire_area_mm2(tyre) + 6 * c10_mpa * area
    return ea, 2 * c10_mpa * area, ea / area * inertia
