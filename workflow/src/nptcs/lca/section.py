"""The ring of the load-bearing model: its section constants and where they come from.

There are two sections. *Sandwich* is the physical one: steel layers at their distance from the
middle of a rubber band of the thickness of table 3. *Printed* repeats the numbers of the paper's
section 3.3.3, whose moment of inertia is that about the wrong axis; it is kept so that both can
be compared.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from math import pi
from typing import Any, Literal, assert_never, get_args

from nptcs.config.solvers.tyre import TyreGeometry
from nptcs.lca.checks import require_positive

SectionKind = Literal["sandwich", "printed"]
SECTION_KINDS: tuple[SectionKind, ...] = get_args(SectionKind)
PHYSICAL_SECTION: SectionKind = "sandwich"


@dataclass(frozen=True)
class ShearBandSection:
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
    ) -> ShearBandSection:
        """Return the section of a tyre whose band rubber has the constant C10.

        Parameters
        ----------
        tyre : TyreGeometry
            Dimensions, wires and their modulus.
        c10_mpa : float
            Neo-Hookean constant of the band's rubber (MPa).
        kind : {"sandwich", "printed"}
            The physical section or that of the paper's section 3.3.3.

        Examples
        --------
        >>> ring = ShearBandSection.from_tyre(TyreGeometry(), c10_mpa=5.0)
        >>> f"{ring.axial_stiffness_n:.4g} N, {ring.bending_stiffness_n_mm2:.4g} N mm2"
        '2.711e+07 N, 1.055e+09 N mm2'
        """
        require_positive("shear_band_c10_mpa", c10_mpa)
        ea, ga, ei = section_stiffness(tyre.model_dump(), c10_mpa, kind)
        return cls(float(ea), float(ga), float(ei), tyre.band_radius_mm, tyre.tread_width_mm)


def section_stiffness(
    dimensions: Mapping[str, Any], c10_mpa: Any, kind: SectionKind = "sandwich"
) -> tuple[Any, Any, Any]:
    """Return EA (N), GA (N) and EI (N mm²), of numbers or of arrays of one shape.

    E = 6 C10 and G = 2 C10 (equations 18 and 19 of the paper); EA is the sum over wires and
    rubber (equation 17).

    Parameters
    ----------
    dimensions : mapping
        Fields of `TyreGeometry` by name (mm, MPa).
    c10_mpa : float or array
        Neo-Hookean constant of the band's rubber (MPa).
    kind : {"sandwich", "printed"}
        Sandwich: A = b h with the thickness h of table 3, EI = E_s A_s (distance/2)², the wires
        being the skins. Printed: A = b h and I = h b³/12 with h the distance of the layers.
    """
    d = dimensions
    width = d["tread_width_mm"]
    wires = d["wire_layers"] * width / d["wire_pitch_mm"] * pi / 4 * d["wire_diameter_mm"] ** 2
    steel = d["wire_modulus_mpa"] * wires
    distance = (d["outer_wire_diameter_mm"] - d["inner_wire_diameter_mm"]) / 2
    match kind:
        case "sandwich":
            area = width * d["shear_band_thickness_mm"]
            return steel + 6 * c10_mpa * area, 2 * c10_mpa * area, steel * (distance / 2) ** 2
        case "printed":
            area = width * distance
            axial = steel + 6 * c10_mpa * area
            return axial, 2 * c10_mpa * area, axial / area * distance * width**3 / 12
        case _:
            assert_never(kind)
