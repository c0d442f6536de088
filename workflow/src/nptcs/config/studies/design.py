"""How the cases of a study are chosen: ``studies[].design``."""

from __future__ import annotations

from math import prod
from typing import Annotated, Literal, assert_never

from pydantic import Field

from nptcs.config.base import Strict

SpaceFillingKind = Literal["latin_hypercube", "sobol"]
AxialCases = Literal["face", "inscribed"]


class FullFactorial(Strict):
    """Every combination of the levels."""

    kind: Literal["full_factorial"] = "full_factorial"


class SpaceFilling(Strict):
    """Cases spread over the box between the lowest and highest level of each factor."""

    kind: SpaceFillingKind = Field(
        description="latin_hypercube: covers each factor's range evenly with points far apart; "
        "sobol: a scrambled Sobol sequence, best with a power of two"
    )
    cases: int = Field(ge=2, description="Number of cases")
    seed: int = Field(
        1, ge=0, description="Seed of the random numbers: the same seed gives the same cases"
    )
    whole_plates: bool = Field(
        False, description="Move each spacing to the nearest one with a whole number of plates"
    )


class CentralComposite(Strict):
    """Corners, axial cases and centre: few cases that determine a second-order polynomial."""

    kind: Literal["central_composite"]
    axial: AxialCases = Field(
        "face",
        description="face: axial cases in the middle of the box's faces, corners in its corners; "
        "inscribed: axial cases there too, and corners moved inwards until the design is rotatable",
    )
    centre_cases: int = Field(
        1, ge=1, description="Cases at the centre; more than one only for results with noise"
    )
    whole_plates: bool = Field(
        False, description="Move each spacing to the nearest one with a whole number of plates"
    )


class BoxBehnken(Strict):
    """Midpoints of the box's edges, and the centre; no case in a corner. Three to five factors."""

    kind: Literal["box_behnken"]
    centre_cases: int = Field(
        1, ge=1, description="Cases at the centre; more than one only for results with noise"
    )
    whole_plates: bool = Field(
        False, description="Move each spacing to the nearest one with a whole number of plates"
    )


class DOptimal(Strict):
    """Those of all combinations of the levels that determine the given terms best."""

    kind: Literal["d_optimal"]
    cases: int = Field(ge=2, description="Number of cases, at least the number of `terms`")
    terms: tuple[str, ...] = Field(
        min_length=1,
        description="Terms that the cases must determine, written as in `terms` of the study",
    )
    starts: int = Field(20, ge=1, description="Number of random starts of the exchange")
    seed: int = Field(
        1, ge=0, description="Seed of the random numbers: the same seed gives the same cases"
    )
    whole_plates: bool = Field(
        False,
        description="Move the spacing of each candidate to the nearest one "
        "with a whole number of plates",
    )


class SplitPlot(Strict):
    """Several cases on each of many values of the factors that are costly to change.

    For the solver `ring`: a spoke costs seconds, a ring on it milliseconds.
    """

    kind: Literal["split_plot"]
    hard_to_change: tuple[str, ...] = Field(
        min_length=1,
        description="Factors that are costly to change, e.g. spacing, thickness, angle and rubber "
        "of the spokes; the others vary on each whole plot",
    )
    whole_plots: int = Field(
        ge=2, description="Number of values of the factors that are costly to change"
    )
    cases_per_plot: int = Field(ge=2, description="Cases on each of them")
    corners: bool = Field(
        True, description="Whether the corners of the costly factors' box are among the whole plots"
    )
    log_spaced: tuple[str, ...] = Field(
        (), description="Factors that are spread evenly in their logarithm, such as moduli"
    )
    seed: int = Field(
        1, ge=0, description="Seed of the random numbers: the same seed gives the same cases"
    )
    whole_plates: bool = Field(
        False, description="Move each spacing to the nearest one with a whole number of plates"
    )


AnyDesign = FullFactorial | SpaceFilling | CentralComposite | BoxBehnken | DOptimal | SplitPlot
Design = Annotated[AnyDesign, Field(discriminator="kind")]


def number_of_cases(design: AnyDesign, levels: list[int]) -> int:
    """Return how many cases a design has, for the number of levels of each factor."""
    factors = len(levels)
    match design:
        case FullFactorial():
            return prod(levels)
        case SpaceFilling() | DOptimal():
            return design.cases
        case SplitPlot():
            return design.whole_plots * design.cases_per_plot
        case CentralComposite():
            return int(2**factors) + 2 * factors + design.centre_cases
        case BoxBehnken():
            return 2 * factors * (factors - 1) + design.centre_cases
        case _:
            assert_never(design)
