"""A study: factors with their levels, the solvers that run it, the surface that is fitted."""

from __future__ import annotations

from itertools import pairwise
from math import prod
from typing import Annotated, Any, ClassVar, Self

from pydantic import Field, field_validator, model_validator

from nptcs.config.base import Strict

Name = Annotated[str, Field(pattern=r"^[a-z][a-z0-9_]*$")]


class MeasuredRubber(Strict):
    """A level that stands for the C10 of a rubber that the laboratory has tested."""

    rubber: str = Field(description="Material name in the specimen sheet, e.g. rubber_75A")


Level = float | MeasuredRubber


class Factor(Strict):
    """One design variable and the levels that it takes."""

    name: Name = Field(description="Column name with its unit, e.g. spacing_mm")
    label: str = Field(description="Name in figures, e.g. 'plate spacing S'")
    unit: str = Field(description="Unit in figures, e.g. 'mm'")
    levels: tuple[Level, ...] = Field(
        min_length=2,
        description="Two levels or more, in growing order; numbers or {rubber: NAME}",
    )

    @field_validator("levels")
    @classmethod
    def _grow(cls, levels: tuple[Level, ...]) -> tuple[Level, ...]:
        numbers = [level for level in levels if not isinstance(level, MeasuredRubber)]
        if any(right <= left for left, right in pairwise(numbers)):
            raise ValueError(f"levels must grow and differ, got {numbers}")
        rubbers = [level.rubber for level in levels if isinstance(level, MeasuredRubber)]
        if len(set(rubbers)) < len(rubbers):
            raise ValueError(f"a rubber is named twice: {rubbers}")
        return levels


class Study(Strict):
    """One full-factorial study of the tyre."""

    name: Name = Field(description="Stem of the case ids and of the result files")
    title: str = Field(description="Heading in the report")
    factors: tuple[Factor, ...] = Field(
        min_length=1, description="Factors; the last one changes fastest from case to case"
    )
    fixed: dict[Name, Level] = Field(
        default_factory=dict, description="Values that all cases share: a number or {rubber: NAME}"
    )
    load_n: float = Field(
        5000.0,
        gt=0,
        description="Vertical load of the secant stiffness; without effect on single spokes",
    )
    solvers: tuple[Name, ...] = Field(min_length=1, description="Solvers that run this study")
    solver_options: dict[Name, dict[str, Any]] = Field(
        default_factory=dict, description="Options of a solver for this study only"
    )
    terms: tuple[str, ...] = Field(
        (),
        description="Terms of the response surface: '1', 'a', 'a^2', 'a*b', with factor names; "
        "without terms no surface is fitted",
    )
    published_coefficients: str | None = Field(
        None, description="CSV with the paper's coefficients (term, coefficient), shown beside ours"
    )
    published_spoke_stiffness: str | None = Field(
        None,
        description="CSV with the paper's table 10, shown beside the single spokes of this study; "
        "the plates are then fixed and spoke_c10_mpa is the only factor",
    )
    calibration_cases: dict[Name, tuple[int, ...]] = Field(
        default_factory=dict,
        description="By solver, the numbers of the cases on whose published stiffness it was "
        "calibrated; the errors of all others are summed up apart from theirs",
    )
    neutral_line_cases: tuple[int, ...] = Field(
        (),
        description="Numbers of the cases whose deformed neutral line is tabulated and drawn "
        "(figure 14), by every solver that computes it",
    )

    AFTERWARDS: ClassVar[frozenset[str]] = frozenset(
        {
            "terms",
            "published_coefficients",
            "published_spoke_stiffness",
            "calibration_cases",
            "neutral_line_cases",
        }
    )
    """Keys that say what is made of the results; they decide no case."""

    def case_definition(self) -> dict[str, Any]:
        """Return what decides the cases of the study and how they are solved, as plain values.

        A change of any other key, or of a heading or label, solves nothing anew. Options of
        solvers are not part of it: each solver has its own. What is returned is a study again.
        """
        kept = self.model_dump(mode="json", exclude={*self.AFTERWARDS, "solver_options"})
        factors = [{**factor, "label": "", "unit": ""} for factor in kept["factors"]]
        return {**kept, "title": "", "factors": factors}

    @model_validator(mode="after")
    def _names_are_consistent(self) -> Self:
        names = [factor.name for factor in self.factors]
        if len(set(names)) < len(names):
            raise ValueError(f"study {self.name}: a factor is named twice: {names}")
        if both := sorted(set(names) & set(self.fixed)):
            raise ValueError(f"study {self.name}: both varied and fixed: {both}")
        if stray := sorted(set(self.solver_options) - set(self.solvers)):
            raise ValueError(
                f"study {self.name}: solver_options for {stray}, which `solvers` does not run"
            )
        if stray := sorted(set(self.calibration_cases) - set(self.solvers)):
            raise ValueError(
                f"study {self.name}: calibration_cases for {stray}, which `solvers` does not run"
            )
        return self

    @model_validator(mode="after")
    def _cases_exist(self) -> Self:
        last = prod(len(factor.levels) for factor in self.factors)
        named = {"neutral_line_cases": self.neutral_line_cases}
        named |= {
            f"calibration_cases.{key}": value for key, value in self.calibration_cases.items()
        }
        for key, numbers in named.items():
            if stray := [number for number in numbers if not 1 <= number <= last]:
                raise ValueError(f"study {self.name}: {key}: {stray} not among cases 1 to {last}")
        return self

    @model_validator(mode="after")
    def _table_10_is_of_one_spoke(self) -> Self:
        names = [factor.name for factor in self.factors]
        if self.published_spoke_stiffness and names != ["spoke_c10_mpa"]:
            raise ValueError(
                f"study {self.name}: table 10 has one spoke for each C10; with "
                f"published_spoke_stiffness the only factor is spoke_c10_mpa, got {names}"
            )
        return self

    def rubbers(self) -> tuple[str, ...]:
        """Name the tested rubbers that levels or fixed values refer to."""
        levels = [level for factor in self.factors for level in factor.levels]
        levels += list(self.fixed.values())
        return tuple(
            dict.fromkeys(level.rubber for level in levels if isinstance(level, MeasuredRubber))
        )
