"""The section ``ingest:`` of the configuration: switches and limits of the conditioning steps."""

from __future__ import annotations

from pathlib import Path

from pydantic import Field, ValidationError, model_validator

from nptcs.config.base import Strict
from nptcs.errors import InputError
from nptcs.yaml_files import read_yaml


class MissingValues(Strict):
    """Dead channels and frames without a strain."""

    enabled: bool = Field(True, description="Drop dead channels and rows that contain no number")
    dead_values: tuple[float, ...] = Field(
        (-1000000.0,), description="Values that a data logger writes for a dead channel"
    )
    spike_share: float = Field(
        0.2,
        gt=0,
        description="A single reading that differs from both neighbours by more than this share of "
        "the channel's range is emptied and flagged",
    )
    largest_share: float = Field(
        0.5,
        gt=0,
        le=1,
        description="A strain channel that lacks more than this share of its readings is dead",
    )


class EndOfTest(Strict):
    """Where the test ends: the force has fallen from its maximum."""

    enabled: bool = Field(True, description="Cut the curve after failure")
    force_drop: float = Field(
        0.4, gt=0, lt=1, description="Fall of the force, as a share of its maximum"
    )


class ExtensometerRemoval(Strict):
    """An extensometer that was taken off or slipped: its strain is emptied from there on."""

    enabled: bool = Field(True, description="Find removal and slip, empty the strain after it")
    jump_factor: float = Field(
        20.0, gt=1, description="A jump is this many times the usual step between readings"
    )
    smallest_jump: float = Field(
        0.0004, gt=0, description="Smallest strain jump that counts, composite tests"
    )
    smallest_jump_rubber: float = Field(
        0.05, gt=0, description="Smallest strain jump that counts, rubber tests"
    )
    stuck_force_share: float = Field(
        0.05, gt=0, lt=1, description="Strain stands still while the force grows by this share"
    )
    largest_return: float = Field(
        0.05,
        gt=0,
        lt=1,
        description="Strain that goes back by more than this share of what it had reached, while "
        "the force is higher than ever, is no longer measured on the specimen",
    )


class OriginOfStrain(Strict):
    """Preload and toe: strain is zero where the curve, extended, meets zero force.

    The line of ASTM D638 annex A1 (toe compensation) becomes a parabola strain(stress), so that
    a curved stress–strain line is not biased; it is fitted over a window of strain above the toe.
    """

    enabled: bool = Field(True, description="Correct preload and toe")
    window: tuple[float, float] = Field(
        (0.0005, 0.003), description="Strain window of the fit, composite tests"
    )
    window_rubber: tuple[float, float] = Field(
        (0.01, 0.10), description="Strain window of the fit, rubber tests"
    )
    smallest_points: int = Field(8, ge=4, description="Fewer points: not corrected, flagged")
    significance: float = Field(
        3.0, ge=0, description="A shift within this many of its standard errors is not applied"
    )
    worst_r_squared: float = Field(
        0.98, gt=0, lt=1, description="Poorer fit: not corrected, flagged"
    )

    @model_validator(mode="after")
    def _windows_in_order(self) -> OriginOfStrain:
        for low, high in (self.window, self.window_rubber):
            if not 0 <= low < high:
                raise ValueError(f"window must be 0 <= lower < upper, got {(low, high)}")
        return self


class ForceZero(Strict):
    """A load cell that was not tared."""

    enabled: bool = Field(
        False, description="Subtract the force before loading; off: preload is a real force"
    )
    readings: int = Field(10, ge=1, description="Readings before loading whose mean is taken")


class Signs(Strict):
    """Tension positive: which part of a record is the test, where the force has both signs."""

    smallest_share: float = Field(
        0.05,
        gt=0,
        lt=1,
        description="Force of the other sign up to this share of the largest is a disturbance; "
        "beyond that, the part is left out and named",
    )
    clear_share: float = Field(
        0.25,
        gt=0,
        lt=1,
        description="A part below this share of the other one is not the test, whatever its sign",
    )


class MachineCompliance(Strict):
    """Correction of crosshead travel; without it the modulus is that of specimen and machine."""

    compliance_mm_per_n: float | None = Field(
        None, ge=0, description="Travel per newton of machine and grips; empty: not corrected"
    )


class Pairing(Strict):
    """Force and strain in separate files."""

    clock_tolerance: float = Field(
        0.03,
        ge=0,
        description="Onsets of loading that are further apart than this share of the time to the "
        "largest force stop the specimen",
    )
    force_tolerance: float = Field(
        0.05,
        gt=0,
        lt=1,
        description="Largest difference of the peaks of a force that both files contain",
    )


class FileLimits(Strict):
    """Largest file that is read; a larger one is refused before it takes time and memory."""

    file_mb: float = Field(500.0, gt=0, description="Size of a raw file in MB")
    unpacked_mb: float = Field(1000.0, gt=0, description="Size of a workbook when unpacked, in MB")
    rows: int = Field(2_000_000, gt=0, description="Lines of a text file or rows of a sheet")
    columns: int = Field(2_000, gt=0, description="Columns of a table")
    line_length: int = Field(100_000, gt=0, description="Characters of a line")


class Plausible(Strict):
    """What physics allows; outside it, a unit or an area must be wrong and the specimen stops."""

    modulus_composite_mpa: tuple[float, float] = Field(
        (300.0, 1.0e6), description="Apparent modulus of a composite or metal test"
    )
    modulus_rubber_mpa: tuple[float, float] = Field(
        (0.005, 300.0), description="Apparent modulus of a rubber test"
    )
    strain_composite: float = Field(
        0.5, gt=0, description="Largest strain of a composite or metal test"
    )
    strain_rubber: float = Field(20.0, gt=0, description="Largest strain of a rubber test")
    area_difference: float = Field(
        0.02, gt=0, description="Machine area / sheet area - 1 beyond this is flagged"
    )


class IngestSettings(Strict):
    """How raw files become curves."""

    limits: FileLimits = FileLimits()
    missing_values: MissingValues = MissingValues()
    end_of_test: EndOfTest = EndOfTest()
    extensometer: ExtensometerRemoval = ExtensometerRemoval()
    force_zero: ForceZero = ForceZero()
    signs: Signs = Signs()
    strain_origin: OriginOfStrain = OriginOfStrain()
    compliance: MachineCompliance = MachineCompliance()
    pairing: Pairing = Pairing()
    plausible: Plausible = Plausible()

    @classmethod
    def as_recorded(cls) -> IngestSettings:
        """Return settings with every step off that can be switched off."""
        return cls(
            missing_values=MissingValues(enabled=False),
            end_of_test=EndOfTest(enabled=False),
            extensometer=ExtensometerRemoval(enabled=False),
            strain_origin=OriginOfStrain(enabled=False),
        )


def limits_in(config: Path) -> FileLimits:
    """Read a configuration's limits on the size of files; the defaults if it has none.

    Raises
    ------
    InputError
        If they are not valid.
    """
    values = read_yaml(config) if config.is_file() else {}
    section = values.get("ingest") if isinstance(values, dict) else None
    limits = section.get("limits") if isinstance(section, dict) else None
    try:
        return FileLimits.model_validate(limits or {})
    except ValidationError as error:
        problem = error.errors()[0]
        key = ".".join(["ingest.limits", *map(str, problem["loc"])])
        raise InputError(
            str(problem["msg"]), "see docs/configuration.md", config, column=key
        ) from (error)
