"""Options of the finite element route: spoke geometry, meshes, table and contact."""

from __future__ import annotations

from collections.abc import Mapping
from math import cos, radians
from typing import Annotated, Any, Literal, Self, assert_never

from pydantic import AfterValidator, Field, field_validator, model_validator

from nptcs.config.base import Strict

PlateCoupling = Literal["embedded", "conforming"]
RingKind = Literal["converged", "paper_mesh"]
AxialFreedom = Literal["free_edges", "plane_strain"]


# fields of a section that are not dimensions: they say what it was calibrated with
CALIBRATION = frozenset({"calibrated_with", "calibrated_axial"})


class SpokeGeometry(Strict):
    """The '<' spoke's section, symmetric about its mid-height; lengths along the radius.

    The paper shows only a drawing (figure 6e): ``nptcs fe-calibrate`` calibrates the defaults on
    table 10 and five cases of table 5 with the ring ``paper_mesh``; ``fe_tyre`` and ``fe_spoke``
    take the section that was calibrated with their own ``ring`` (`SECTIONS`).
    """

    leg_angle_deg: float = Field(29.5, gt=0, lt=60, description="Leg's angle from the radius")
    height_mm: float = Field(84.1, gt=0, description="From the rim to the band")
    leg_thickness_mm: float = Field(2.5, gt=0, description="Normal to the leg")
    block_thickness_mm: float = Field(
        11.768, gt=0, description="Rubber block at mid-height, normal to the leg"
    )
    block_half_length_mm: float = Field(5.8, gt=0, description="Half the block's height")
    block_ramp_mm: float = Field(4.327, gt=0, description="Height of the ramp from leg to block")
    foot_thickness_mm: float = Field(
        13.548, gt=0, description="At the rim and the band, normal to the leg"
    )
    foot_taper_mm: float = Field(10.617, gt=0, description="Height of the taper from foot to leg")
    plate_foot_gap_mm: float = Field(5.0, gt=0, description="Plate's end above the rim")
    plate_mid_gap_mm: float = Field(5.5, gt=0, description="Plate's end short of mid-height")
    plate_layer_mm: float = Field(
        1.0,
        gt=0,
        description="Thickness of the mesh layer that carries the plate; its stiffness is that of "
        "the true plies, as with a shell embedded in the rubber",
    )
    calibrated_with: RingKind | None = Field(
        None,
        description="Ring of the tyres that the section was calibrated with, as `nptcs "
        "fe-calibrate` prints it: it is refused with any other ring; null for a section that was "
        "drawn or measured",
    )
    calibrated_axial: AxialFreedom | None = Field(
        None,
        description="Axial freedom (`axial`) of the tyres that the section was calibrated with, as "
        "`nptcs fe-calibrate` prints it: cases solved with another one say so",
    )

    @model_validator(mode="after")
    def _breaks_in_order(self) -> Self:
        half = self.height_mm / 2.0
        breaks = {
            "plate_foot_gap_mm": self.plate_foot_gap_mm,
            "foot_taper_mm": self.foot_taper_mm,
            "start of the block's ramp": half - self.block_half_length_mm - self.block_ramp_mm,
            "start of the block": half - self.block_half_length_mm,
            "plate's upper end": half - self.plate_mid_gap_mm,
            "mid-height": half,
        }
        heights = list(breaks.values())
        if any(b - a < 1e-3 for a, b in zip(heights[:-1], heights[1:], strict=True)):
            raise ValueError(f"heights along a leg must increase in this order, got {breaks}")
        thinnest = min(self.leg_thickness_mm, self.block_thickness_mm, self.foot_thickness_mm)
        if self.plate_layer_mm >= thinnest:
            raise ValueError("plate_layer_mm must be thinner than leg, block and foot")
        return self

    def as_drawn(self) -> Self:
        """Return the same section without the ring and the option of its calibration."""
        return self.model_copy(update=dict.fromkeys(CALIBRATION))

    def axial_notes(self, axial: AxialFreedom) -> list[str]:
        """Say if the section was calibrated with tyres of an axial freedom other than this one."""
        if self.calibrated_axial in (None, axial):
            return []
        return [
            f"the spoke's section was calibrated with `axial: {self.calibrated_axial}` and makes "
            f"up for the stiffness of that option; this tyre has `axial: {axial}`"
        ]

    def section(self) -> tuple[tuple[float, ...], tuple[float, ...]]:
        """Return the heights of the lower leg's breaks and its thickness there, mm."""
        half = self.height_mm / 2.0
        gap, taper = self.plate_foot_gap_mm, self.foot_taper_mm
        shrink = (self.foot_thickness_mm - self.leg_thickness_mm) * gap / taper
        at_gap = self.foot_thickness_mm - shrink
        heights = (
            0.0,
            gap,
            taper,
            half - self.block_half_length_mm - self.block_ramp_mm,
            half - self.block_half_length_mm,
            half - self.plate_mid_gap_mm,
            half,
        )
        leg, block = self.leg_thickness_mm, self.block_thickness_mm
        return heights, (self.foot_thickness_mm, at_gap, leg, leg, block, block, block)

    def foot_width_mm(self) -> float:
        """Width of the foot along the circumference."""
        return self.foot_thickness_mm / cos(radians(self.leg_angle_deg))


def _without_layer(section: SpokeGeometry) -> SpokeGeometry:
    if section.plate_layer_mm != SpokeGeometry.model_fields["plate_layer_mm"].default:
        raise ValueError("plate_layer_mm has no effect on this solver's mesh: leave it out")
    return section


# section of a spoke whose mesh has no separate layer for the plates
LayerlessGeometry = Annotated[SpokeGeometry, AfterValidator(_without_layer)]


class SpokeMesh(Strict):
    """Numbers of quadratic elements of the spoke's mesh."""

    rows: tuple[int, int, int, int, int, int] = Field(
        (1, 2, 4, 1, 1, 1),
        description="Along a leg: foot to plate, taper, leg, ramp, block with plate, block",
    )
    columns: int = Field(1, ge=1, description="Across the rubber on each side of the plate")
    plate_columns: int = Field(1, ge=1, description="Across the width of the plate")
    gap_columns: int = Field(2, ge=1, description="Across the rubber between two plates")
    bulk_to_shear_ratio: float = Field(
        2000.0,
        ge=100,
        le=1e6,
        description="κ/2C10 of the rubber; the paper's D1 = 0 is its limit",
    )

    @model_validator(mode="after")
    def _positive(self) -> Self:
        if min(self.rows) < 1:
            raise ValueError(f"rows must all be 1 or more, got {self.rows}")
        return self


class EnergyTableOptions(Strict):
    """Range and sampling of the spoke's energy table."""

    elongation_mm: tuple[float, float] = Field(
        (-40.0, 8.0),
        description="Change of the distance from the rim's foot to the band's, about u_r; a spoke "
        "that loses its stability before the lower end has a shorter table",
    )
    inclination_rad: float = Field(
        0.2,
        gt=0,
        lt=0.8,
        description="Largest inclination of that line from the mean direction of the two feet, to "
        "either side: β = atan(u_θ / (height + u_r)) + φ/2",
    )
    phi_rad: tuple[float, float] = Field((-0.15, 0.15), description="Rotation of the band")
    narrowing: float = Field(
        0.54,
        gt=0,
        le=1,
        description="Part of the ranges of β and φ that is left at the lowest elongation, linear "
        "from the unloaded one: the most compressed spokes are over the ground and hardly turn",
    )
    samples: tuple[int, int, int] = Field(
        (7, 3, 3),
        description="Numbers of states of the elongation (one next to the unloaded state is left "
        "out), β and φ; for β < 0 they are known from the spoke's symmetry",
    )
    side_states: Literal["alternate", "every"] = Field(
        "alternate",
        description="States other than β = φ = 0: alternate has one at both ends and at every "
        "second level of the elongation, alternating between neighbouring rows; every has all of "
        "them, which takes half as much time again",
    )
    accepted_work: float = Field(
        1e-7,
        ge=1e-12,
        le=1e-6,
        description="A state is accepted when the work of the next Newton step is below this part "
        "of its energy; its tangent is accurate only to the square root of this",
    )
    degrees: tuple[int, int] = Field(
        (11, 5), description="Polynomial degree in the elongation, and total degree in β and φ"
    )

    @model_validator(mode="after")
    def _ranges_hold_rest(self) -> Self:
        for name in ("elongation_mm", "phi_rad"):
            low, high = getattr(self, name)
            if not low < 0.0 < high:
                raise ValueError(f"{name} must run from a negative to a positive number")
        if min(self.samples) < 3:
            raise ValueError(f"samples must be 3 or more in each direction, got {self.samples}")
        return self


class TyreMesh(Strict):
    """Mesh of the converged ring: quadratic quadrilaterals that end at the spokes' feet."""

    foot_elements: int = Field(1, ge=1, description="Along the circumference under a spoke's foot")
    gap_elements: int = Field(1, ge=1, description="Along the circumference between two feet")
    cover_rows: int = Field(
        1, ge=1, description="Across the rubber inside the inner wires and outside the outer ones"
    )
    band_rows: int = Field(1, ge=1, description="Across the shear band between its wire layers")
    tread_rows: int = Field(1, ge=1, description="Across the tread outside the band")
    wire_row_mm: float = Field(
        0.05,
        gt=0,
        le=0.2,
        description="Depth of the rows of elements in which the wires bend; it replaces part of "
        "the rubber between the wires, which then shears less, so it must stay thin",
    )
    first_spoke_deg: float = Field(
        0.0, description="Angle of a spoke's feet from the middle of the contact"
    )


# columns of the ring of table 4: 270 × (2 + 2) rows × 31 across the width are its 33,480 bricks
PAPER_COLUMNS = 270


class PaperMesh(Strict):
    """Mesh of the ring as in table 4: quadrilaterals of four nodes with one pressure each.

    Two rows in the band and two in the tread; the wires are membranes embedded in them, and
    contact with the ground acts at the nodes.
    """

    around: int = Field(PAPER_COLUMNS, ge=120, description="Elements around the circumference")
    first_spoke_deg: float = Field(
        0.0, description="Angle of a spoke's feet from a node in the middle of the contact"
    )

    @field_validator("around")
    @classmethod
    def _coarse_enough(cls, around: int) -> int:
        if around > PAPER_COLUMNS:
            raise ValueError(
                f"at most {PAPER_COLUMNS} elements: the wires are membranes, which wrinkle in the "
                "compressed layer at the length of the elements, so a finer ring gets softer "
                "without a limit; refine the ring `converged`, whose wires bend"
            )
        return around


class GroundContact(Strict):
    """Contact of the tread with the rigid plane: a smoothed penalty and Coulomb friction."""

    friction: float = Field(0.3, ge=0, lt=2, description="Coefficient of friction, section 3.2")
    penalty_mpa_per_mm: float = Field(500.0, gt=0, description="Pressure per mm of penetration")
    smoothing_mm: float = Field(
        0.002,
        gt=0,
        description="Penetration below which the pressure grows quadratically; it counts as "
        "displacement of the tyre",
    )
    tangential_mpa_per_mm: float = Field(
        10.0, gt=0, description="Shear traction per mm of elastic slip"
    )


SECTIONS: Mapping[RingKind, SpokeGeometry] = {
    "paper_mesh": SpokeGeometry(calibrated_with="paper_mesh", calibrated_axial="free_edges"),
    "converged": SpokeGeometry(
        leg_angle_deg=29.502,
        leg_thickness_mm=2.547,
        block_thickness_mm=10.690,
        block_half_length_mm=5.8,
        block_ramp_mm=4.539,
        foot_thickness_mm=14.0,
        foot_taper_mm=11.0,
        plate_foot_gap_mm=4.861,
        plate_mid_gap_mm=5.5,
        calibrated_with="converged",
        calibrated_axial="free_edges",
    ),
}
"""Sections that `nptcs fe-calibrate` found with each ring."""


class FeSpokeModel(Strict):
    """What a single spoke depends on that does not vary from case to case."""

    ring: RingKind = Field(
        "converged",
        description="Ring of the tyre, and with it the section of the spoke that was calibrated "
        "with it. converged: wires that bend, results that do not depend on the mesh; paper_mesh: "
        "the ring as in table 4 of the paper, membranes in coarse elements, to compare with the "
        "paper",
    )
    geometry: SpokeGeometry = Field(
        default_factory=SpokeGeometry,
        description="The spoke; a dimension that is not given is that of the section calibrated "
        "with `ring`",
    )
    spoke_mesh: SpokeMesh = Field(default_factory=SpokeMesh, description="Mesh of the spoke")
    plate_coupling: PlateCoupling = Field(
        "embedded",
        description="embedded: the plates' mid-surface stays straight across their width, like "
        "that of the paper's shells in bricks as wide as the plates; conforming: it moves with the "
        "rubber and may bow",
    )

    @model_validator(mode="before")
    @classmethod
    def _section_of_the_ring(cls, values: Any) -> Any:
        """Complete the section from that of the ring; it is calibrated only if left unchanged."""
        if not isinstance(values, dict):
            return values
        section = SECTIONS.get(values.get("ring", cls.model_fields["ring"].default))
        given = values.get("geometry", {})
        if section is None or not isinstance(given, Mapping):
            return values
        kept = section.model_dump(exclude=set(CALIBRATION) if given else None)
        return {**values, "geometry": {**kept, **given}}

    @model_validator(mode="after")
    def _section_fits_the_ring(self) -> Self:
        drawn = self.geometry.as_drawn()
        same = [ring for ring, section in SECTIONS.items() if section.as_drawn() == drawn]
        found = self.geometry.calibrated_with
        if found is None and same and self.ring not in same:
            found = same[0]
        if found not in (None, self.ring):
            raise ValueError(
                f"the section was calibrated with the ring '{found}', on which it makes up for "
                f"that ring's own stiffness: choose `ring: {found}`, leave `geometry` out, or "
                f"calibrate again with `nptcs fe-calibrate --ring {self.ring}`"
            )
        return self


AXIAL_BULK_TO_SHEAR = 10.0
"""κ/2C10 with which a ring in plane strain is as soft as one 215 mm wide with free edges on ground
that neither slips nor sticks completely along the axis (``benchmarks/fe_axial_freedom.py``,
docs/methods/fe-theory.md)."""


class FeModel(FeSpokeModel):
    """All parts of the finite element route that do not vary from case to case."""

    axial: AxialFreedom = Field(
        "free_edges",
        description="Freedom of band and tread along the axis. free_edges: as in a tyre of the "
        "paper's width, by a bulk-to-shear ratio of 10 in plane strain, with which the sections "
        "were calibrated; plane_strain: none, nearly incompressible",
    )
    table: EnergyTableOptions = Field(
        default_factory=EnergyTableOptions, description="Energy table of the spoke"
    )
    tyre_mesh: TyreMesh = Field(
        default_factory=TyreMesh, description="Mesh of band and tread, ring `converged`"
    )
    paper_mesh: PaperMesh = Field(
        default_factory=PaperMesh, description="Mesh of band and tread, ring `paper_mesh`"
    )
    contact: GroundContact = Field(default_factory=GroundContact, description="The ground")
    load_steps: int = Field(10, ge=2, description="Load steps to the load of the case")

    @model_validator(mode="after")
    def _mesh_of_the_ring(self) -> Self:
        unused = {"converged": "paper_mesh", "paper_mesh": "tyre_mesh"}[self.ring]
        mesh = getattr(self, unused)
        if mesh != type(mesh)():
            raise ValueError(f"{unused} has no effect with `ring: {self.ring}`: leave it out")
        return self

    def ring_mesh(self) -> TyreMesh | PaperMesh:
        """Return the mesh of the chosen ring."""
        match self.ring:
            case "converged":
                return self.tyre_mesh
            case "paper_mesh":
                return self.paper_mesh
            case _:
                assert_never(self.ring)

    def band_bulk_to_shear(self) -> float:
        """Return κ/2C10 of band and tread."""
        match self.axial:
            case "free_edges":
                return AXIAL_BULK_TO_SHEAR
            case "plane_strain":
                return self.spoke_mesh.bulk_to_shear_ratio
            case _:
                assert_never(self.axial)
