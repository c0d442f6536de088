"""The material card: constants with their uncertainty and where they came from."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Literal

from pydantic import Field

from nptcs.config.base import Strict

PLY_CONSTANTS = (
    "e1_mpa",
    "e2_mpa",
    "e3_mpa",
    "nu12",
    "nu13",
    "nu23",
    "g12_mpa",
    "g13_mpa",
    "g23_mpa",
)

PUBLISHED_PLY = {
    "e1_mpa": 128000.0,
    "e2_mpa": 8800.0,
    "e3_mpa": 8800.0,
    "nu12": 0.357,
    "nu13": 0.357,
    "nu23": 0.35,
    "g12_mpa": 3147.0,
    "g13_mpa": 3147.0,
    "g23_mpa": 2300.0,
}
"""The ply that the paper prints in table 2."""

PUBLISHED_C10_MPA = {"rubber_75A": 1.18, "rubber_88A": 2.91, "rubber_92A": 4.77}
"""C10 within 15 % strain that section 3.1 of the paper prints, by the example's names."""


class CardConstant(Strict):
    """One constant: its value, its uncertainty and its origin."""

    value: float
    unit: str = Field(description="'MPa' or '1' (dimensionless)")
    standard_error: float | None = Field(
        None, description="Standard error of the mean over specimens; none for an assumption"
    )
    origin: Literal["measured", "assumed"]
    rule: str = Field(description="Standard, range and statistic, or the stated assumption")
    specimens: tuple[str, ...] = Field((), description="Specimens that it is based on")
    equal_to: str | None = Field(
        None, description="Constant that this one is assumed to equal, and varies with"
    )


class Covariance(Strict):
    """Covariance matrix of the estimates of the measured constants, in the order of `names`.

    The diagonal contains the squared standard errors: the uncertainty of the means, not the scatter
    of the material.
    """

    names: tuple[str, ...]
    units: tuple[str, ...] = Field((), description="Units of the constants, in that order")
    rule: str = Field("", description="How it was estimated, off the diagonal too")
    specimens: tuple[str, ...] = Field((), description="Specimens that it is based on")
    matrix: tuple[tuple[float, ...], ...] = Field(description="Unit: product of the two units")


class PlyCard(Strict):
    """The nine constants of an orthotropic ply, table 2 of the paper."""

    name: str
    synthetic: bool = Field(description="True if any source specimen is synthetic")
    constants: dict[str, CardConstant] = Field(description="Keys: " + ", ".join(PLY_CONSTANTS))
    covariance: Covariance | None = None
    checks: tuple[str, ...] = Field((), description="What the consistency checks found, in words")

    def values(self) -> dict[str, float]:
        """Return the bare numbers, by constant name."""
        return {name: quantity.value for name, quantity in self.constants.items()}


class RubberCard(Strict):
    """Hyperelastic constants of one rubber; the study's model is neo-Hookean."""

    name: str
    synthetic: bool = Field(description="True if any source specimen is synthetic")
    model: str = Field("neo_hookean", description="Name of the hyperelastic model")
    constants: dict[str, CardConstant] = Field(description="For neo-Hookean: c10_mpa")
    covariance: Covariance | None = None
    strain_range: tuple[float, float] = Field(description="Nominal strain range of the fit")
    fit_quality: dict[str, float] = Field(
        default_factory=dict, description="rmse_mpa, largest_error_percent, drucker_stable, …"
    )
    checks: tuple[str, ...] = ()


class MaterialCard(Strict):
    """Everything that the solvers may know of the materials, in one JSON file."""

    format: Literal["nptcs-material-card/1"] = "nptcs-material-card/1"
    plies: dict[str, PlyCard]
    rubbers: dict[str, RubberCard]

    @classmethod
    def joined(cls, plies: Iterable[PlyCard], rubbers: Iterable[RubberCard]) -> MaterialCard:
        """Join the cards of plies and rubbers, each under its name."""
        return cls(
            plies={card.name: card for card in plies},
            rubbers={card.name: card for card in rubbers},
        )
