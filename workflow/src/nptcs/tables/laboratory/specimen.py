"""One row of the specimen sheet: what a laboratory states about one test of a specimen."""

from __future__ import annotations

import re
from datetime import date as Date
from math import pi
from pathlib import PurePosixPath
from typing import Literal, Self

from pydantic import Field, ValidationInfo, field_validator, model_validator

from nptcs.bending import BentBar
from nptcs.config.base import Strict
from nptcs.mechanical_tests import TestType, is_property, property_names

Platens = Literal["", "lubricated", "dry", "bonded"]
"""How the faces of a disc meet the platens; empty: not stated."""

NAME = r"^[A-Za-z0-9._-]+$"
STATIONS = ("width_mm", "thickness_mm", "diameter_mm")
LISTS = (*STATIONS, "properties")
WEIGHED = ("mass_g", "length_mm", "density_g_per_cm3")
LOADING = r"^(first|last|envelope|[1-9][0-9]{0,3})$"


class Specimen(Strict):
    """One row of the specimen sheet: one test, or one run of several on the same piece.

    Lengths in mm. `width_mm`, `thickness_mm` and `diameter_mm` contain the stations measured; their
    means enter the area (ASTM D3039 §11.2.3). For any other section `section_area_mm2` is stated (a
    published curve of stress alone: 1 mm²), or mass, length and density, which give the area.
    """

    specimen: str = Field(pattern=NAME, description="Id, unique in the sheet")
    test: TestType = Field(description="Test type: " + ", ".join(TestType))
    material: str = Field(pattern=NAME, description="E.g. cfrp, rubber_75A")
    orientation_deg: float | None = Field(
        None, ge=-90, le=90, description="Fibre angle to the load: 0, 90, 45; empty for rubber"
    )
    width_mm: tuple[float, ...] = Field((), description="Stations, separated by ';'")
    thickness_mm: tuple[float, ...] = Field((), description="Stations, separated by ';'")
    section_area_mm2: float | None = Field(
        None, gt=0, description="Area of a section that is not width × thickness; usually empty"
    )
    gauge_length_mm: float | None = Field(
        None,
        gt=0,
        description="Gauge length (grip distance for crosshead strain, height of a disc)",
    )
    force_file: str = Field(min_length=1, description="Path relative to the sheet's folder")
    force_part: str = Field(
        "", description="Workbook sheet, table number or test name, if the file contains several"
    )
    force_format: str = Field("", description="Profile name; empty: detect")
    strain_file: str = Field("", description="Empty: the strain is in the force file")
    strain_part: str = Field("", description="As force_part")
    strain_format: str = Field("", description="Profile name; empty: detect")
    strain_axis: str = Field(
        "", description="Channel that is axial (e.g. exx); empty: found from the data"
    )
    time_offset_s: float | None = Field(
        None,
        description="Added to the strain file's time; empty: from the force that both files "
        "contain, otherwise 0, which is checked",
    )
    include: bool = Field(True, description="yes or no: enters statistics and material card")
    reason: str = Field("", description="Why the specimen is left out; required with no")
    origin: Literal["measured", "synthetic"] = Field("measured", description="measured, synthetic")
    remarks: str = Field("", description="Anything else")
    piece: str = Field(
        "",
        pattern=NAME.replace("+", "*"),
        description="Piece that was tested, where several rows are runs on the same one; "
        "empty: the row is a separate piece",
    )
    properties: tuple[str, ...] = Field(
        (),
        description="Properties that count from this run (e.g. modulus;poisson_ratio; for the "
        "fit of a rubber: hyperelastic_fit), separated by ';'; empty: all",
    )
    loading: str = Field(
        "first",
        pattern=LOADING,
        description="Which loading of a cyclic test is reduced: first, last, its number, or "
        "envelope (of all loadings)",
    )
    failed: bool | None = Field(
        None,
        description="yes: it broke, although the record does not show it; no: stopped before "
        "failure; empty: judged from the record",
    )
    force_factor: float = Field(1.0, description="Factor of the force as the file gives it")
    strain_factor: float = Field(
        1.0, description="Factor of the strain or travel as the file gives it"
    )
    transverse_factor: float = Field(
        1.0,
        description="Factor of the transverse strain; -1 where a contraction is written positive",
    )
    transverse_length_mm: float | None = Field(
        None,
        gt=0,
        description="Length over which a transverse extensometer in mm measures, e.g. the width",
    )
    diameter_mm: tuple[float, ...] = Field(
        (), description="Stations of a round bar or disc, separated by ';'"
    )
    mass_g: float | None = Field(
        None, gt=0, description="With length and density: area = mass / (density × length)"
    )
    length_mm: float | None = Field(None, gt=0, description="Length of the piece that was weighed")
    density_g_per_cm3: float | None = Field(None, gt=0, description="Density of the material")
    span_mm: float | None = Field(None, gt=0, description="Flexure: distance of the supports")
    loading_span_mm: float | None = Field(
        None,
        gt=0,
        description="Flexure at four points: distance of the loading rollers; empty: three points",
    )
    platens: Platens = Field(
        "", description="Compression of discs: lubricated, dry or bonded; empty: not known"
    )
    date: Date | None = Field(None, description="Day of the test, e.g. 2026-03-31")
    operator: str = Field("", description="Who ran the test")
    machine: str = Field("", description="Testing machine, load cell, strain measurement")
    temperature_c: float | None = Field(None, gt=-273.15, description="Temperature of the test")
    humidity_percent: float | None = Field(
        None, ge=0, le=100, description="Relative humidity during the test"
    )

    @field_validator(*STATIONS)
    @classmethod
    def _stations_positive(
        cls, stations: tuple[float, ...], info: ValidationInfo
    ) -> tuple[float, ...]:
        if any(station <= 0 for station in stations):
            raise ValueError(f"{info.field_name} must be greater than 0")
        return stations

    @field_validator("force_factor", "strain_factor", "transverse_factor")
    @classmethod
    def _not_zero(cls, factor: float, info: ValidationInfo) -> float:
        if factor == 0:
            raise ValueError(f"{info.field_name} must not be 0")
        return factor

    @field_validator("force_file", "strain_file")
    @classmethod
    def _inside_the_folder(cls, path: str) -> str:
        parts = PurePosixPath(path.replace("\\", "/"))
        if parts.is_absolute() or ".." in parts.parts or re.match(r"^[A-Za-z]:", path):
            raise ValueError("must be in the sheet's folder (a relative path without '..')")
        return str(parts) if path else ""

    @model_validator(mode="after")
    def _complete(self) -> Self:
        for find_fault in (_section_fault, _orientation_fault, _flexure_fault, _property_fault):
            if fault := find_fault(self):
                raise ValueError(fault)
        if not self.include and not self.reason.strip():
            raise ValueError("reason is empty: a specimen that is left out needs one")
        return self

    @property
    def mean_width_mm(self) -> float | None:
        """Mean of the width stations, None if none was measured."""
        return _mean(self.width_mm) if self.width_mm else None

    @property
    def mean_thickness_mm(self) -> float | None:
        """Mean of the thickness stations, None if none was measured."""
        return _mean(self.thickness_mm) if self.thickness_mm else None

    @property
    def area_mm2(self) -> float:
        """Original cross-section (mm²), by the first of the rules that the row states."""
        return self._area[0]

    @property
    def area_rule(self) -> str:
        """How the area was determined, in words."""
        return self._area[1]

    @property
    def _area(self) -> tuple[float, str]:
        if self.section_area_mm2 is not None:
            return self.section_area_mm2, "stated"
        if self.diameter_mm:
            return pi / 4 * _mean(self.diameter_mm) ** 2, "pi/4 × mean diameter²"
        if self.mass_g is not None and self.length_mm and self.density_g_per_cm3:
            volume_mm3 = 1000 * self.mass_g / self.density_g_per_cm3
            return volume_mm3 / self.length_mm, "mass / (density × length)"
        return _mean(self.width_mm) * _mean(self.thickness_mm), "mean width × mean thickness"

    @property
    def bar(self) -> BentBar | None:
        """Section and spans of a bending test; None for any other."""
        if not self.test.is_bending or self.span_mm is None:
            return None
        width, thickness = _mean(self.width_mm), _mean(self.thickness_mm)
        return BentBar(width, thickness, self.span_mm, self.loading_span_mm or 0.0)

    @property
    def force_per_stress_mm2(self) -> float:
        """F/σ: the area, or for a bent bar that of the stress of its outer face."""
        return self.area_mm2 if self.bar is None else 1.0 / self.bar.stress_per_force

    def strain_per_length(self, of_crosshead: bool) -> float:
        """Strain for each mm of an extension, or of a bar's deflection (1/mm).

        Parameters
        ----------
        of_crosshead : bool
            Travel of the machine: with four points it is that of the loading rollers, not of
            mid-span.

        Raises
        ------
        ValueError
            If the gauge length is empty.
        """
        if self.bar is not None:
            return (
                self.bar.strain_per_roller_travel
                if of_crosshead and self.bar.points == 4
                else self.bar.strain_per_deflection
            )
        if self.gauge_length_mm is None:
            raise ValueError(f"{self.specimen}: gauge_length_mm is empty")
        return 1.0 / self.gauge_length_mm

    @property
    def tested_piece(self) -> str:
        """Id of the piece: runs on the same one share it."""
        return self.piece or self.specimen

    def gives(self, property_name: str) -> bool:
        """Whether a property of this run counts in statistics and cards."""
        return self.include and (not self.properties or property_name in self.properties)

    @property
    def series(self) -> str:
        """Group of equal tests, e.g. ``cfrp_tension_0``; safe in file names."""
        parts = [self.material, self.test.value]
        if self.orientation_deg is not None:
            parts.append(f"{self.orientation_deg:g}")
        return "_".join(parts)

    @property
    def files(self) -> tuple[str, ...]:
        """The raw files of this specimen, without repetition."""
        names = [self.force_file, self.strain_file]
        return tuple(dict.fromkeys(name for name in names if name))


def _mean(stations: tuple[float, ...]) -> float:
    return sum(stations) / len(stations)


def _section_fault(row: Specimen) -> str:
    """Say which dimension is missing for the stress."""
    weighed = [name for name in WEIGHED if getattr(row, name) is not None]
    rectangle = row.width_mm and row.thickness_mm
    if not row.test.is_bending:
        if row.section_area_mm2 is not None or row.diameter_mm:
            return ""
        if weighed and not rectangle:
            missing = [name for name in WEIGHED if name not in weighed]
            return f"{missing[0]} is empty: the area needs {', '.join(WEIGHED)}" if missing else ""
    for name in ("width_mm", "thickness_mm"):
        if not getattr(row, name):
            return f"{name} is empty: the stress cannot be computed"
    return ""


def _orientation_fault(row: Specimen) -> str:
    if row.test.is_rubber and row.orientation_deg is not None:
        return "orientation_deg must be empty for a rubber"
    if not row.test.is_rubber and row.orientation_deg is None:
        return "orientation_deg is empty: give the fibre angle (0, 90, 45)"
    return ""


def _flexure_fault(row: Specimen) -> str:
    """Say what is wrong with the spans of a bending test, or that another test has no spans."""
    if not row.test.is_bending:
        spans = [name for name in ("span_mm", "loading_span_mm") if getattr(row, name) is not None]
        return f"{spans[0]} must be empty for a {row.test} test" if spans else ""
    if row.span_mm is None:
        return "span_mm is empty: give the distance of the supports"
    if row.loading_span_mm is not None and row.loading_span_mm >= row.span_mm:
        return "loading_span_mm must be smaller than span_mm"
    return ""


def _property_fault(row: Specimen) -> str:
    for name in row.properties:
        if not is_property(row.test, name):
            known = ", ".join(property_names(row.test))
            return f"properties names '{name}', but a {row.test} test gives {known}"
    return ""
