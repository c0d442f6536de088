"""A study: factors with their levels, the solvers that run it, the surfaces fitted to it."""

from __future__ import annotations

from itertools import pairwise
from typing import Any, ClassVar, Self

from pydantic import Field, field_validator, model_validator

from nptcs.config.base import Name, Strict
from nptcs.config.studies.decisions import Decision
from nptcs.config.studies.design import Design, DOptimal, FullFactorial, SplitPlot, number_of_cases
from nptcs.config.studies.response import ResponseChoice
from nptcs.config.studies.surface import SurfaceModel, needs_ply, own_terms, surface_name
from nptcs.ranges import RANGES
from nptcs.terms import parse


class MeasuredRubber(Strict):
    """A level given as a rubber that the laboratory has tested: it stands for that rubber's C10."""

    rubber: str = Field(description="Material name in the specimen sheet, e.g. rubber_75A")


Level = float | MeasuredRubber


class Factor(Strict):
    """One design variable and the levels that it takes."""

    name: Name = Field(description="Column name with its unit, e.g. spacing_mm")
    label: str = Field(description="Name in figures, e.g. 'plate spacing S'")
    unit: str = Field(description="Unit in figures, e.g. 'mm'")
    levels: tuple[Level, ...] = Field(
        min_length=2,
        description="Two or more levels in increasing order: numbers, or {rubber: NAME}",
    )

    @field_validator("levels")
    @classmethod
    def _grow(cls, levels: tuple[Level, ...]) -> tuple[Level, ...]:
        numbers = [level for level in levels if not isinstance(level, MeasuredRubber)]
        if any(right <= left for left, right in pairwise(numbers)):
            raise ValueError(f"levels must increase, got {numbers}")
        rubbers = [level.rubber for level in levels if isinstance(level, MeasuredRubber)]
        if len(set(rubbers)) < len(rubbers):
            raise ValueError(f"a rubber is named twice: {rubbers}")
        return levels


class Study(Strict):
    """One study of the tyre: factors, how its cases are chosen, solvers, surfaces."""

    name: Name = Field(description="Stem of the case ids and of the result files")
    title: str = Field(description="Heading in the report")
    factors: tuple[Factor, ...] = Field(
        min_length=1, description="Factors; the last one changes fastest from case to case"
    )
    design: Design = Field(
        FullFactorial(),
        description="How the cases are chosen; kinds other than full_factorial and d_optimal use "
        "only the lowest and the highest level of each factor",
    )
    further_cases: tuple[dict[Name, float], ...] = Field(
        (),
        description="Cases in addition to those of the design, each with a value for every factor; "
        "`nptcs augment` proposes some",
    )
    reference: dict[Name, float] = Field(
        default_factory=dict,
        description="Reference design, a value for each factor, whose responses are reported with "
        "their uncertainty; empty: none",
    )
    decisions: tuple[Decision, ...] = Field(
        (), description="Which design meets these goals? Answered from the study's solved cases"
    )
    fixed: dict[Name, Level] = Field(
        default_factory=dict, description="Values that all cases share: a number or {rubber: NAME}"
    )
    load_n: float = Field(
        5000.0,
        gt=0,
        description="Vertical load at which the secant stiffness is taken; no effect on single "
        "spokes",
    )
    ply: str | None = Field(
        None,
        description="Composite of the specimen sheet whose card the solvers use; null: the only "
        "composite in the sheet",
    )
    solvers: tuple[Name, ...] = Field(
        min_length=1, description="Solvers that solve the cases of this study"
    )
    solver_options: dict[Name, dict[str, Any]] = Field(
        default_factory=dict, description="Options of a solver for this study only"
    )
    terms: tuple[str, ...] = Field(
        (),
        description="Terms of the response surface: '1', 'a', 'a^2', 'a*b', with factor names; "
        "without terms no surface is fitted",
    )
    least_cases: int | None = Field(
        None,
        ge=2,
        description="Fewest solved cases of a solver to which a surface is fitted; null: one more "
        "than the number of `terms`",
    )
    surfaces: tuple[SurfaceModel, ...] = Field(
        (),
        description="Surfaces that are fitted and compared with the polynomial of `terms`: other "
        "polynomials, the lamination form, Gaussian processes",
    )
    responses: tuple[ResponseChoice, ...] = Field(
        (),
        description="Responses to which the same surfaces are fitted, besides the secant stiffness "
        "at `load_n`: e.g. plate_mass, {name: secant_stiffness, load_n: 3000}. A case that does "
        "not have one is left out of its surfaces and counted",
    )
    published_coefficients: str | None = Field(
        None,
        description="CSV with the paper's coefficients (term, coefficient), shown next to the "
        "fitted ones",
    )
    published_spoke_stiffness: str | None = Field(
        None,
        description="CSV with the paper's table 10, shown next to the single spokes of this study; "
        "the plates are then fixed, and spoke_c10_mpa is the only factor",
    )
    calibration_cases: dict[Name, tuple[int, ...]] = Field(
        default_factory=dict,
        description="By solver, the numbers of the cases on whose published stiffness it was "
        "calibrated; the errors of all other cases are summarised separately",
    )
    neutral_line_cases: tuple[int, ...] = Field(
        (),
        description="Numbers of the cases whose deformed neutral line is tabulated and drawn "
        "(figure 14), by every solver that computes it",
    )

    AFTERWARDS: ClassVar[frozenset[str]] = frozenset(
        {
            "reference",
            "decisions",
            "terms",
            "least_cases",
            "surfaces",
            "responses",
            "published_coefficients",
            "published_spoke_stiffness",
            "calibration_cases",
            "neutral_line_cases",
        }
    )
    """Keys that say what is done with the results; they affect no case."""

    def case_definition(self) -> dict[str, Any]:
        """Return what decides the cases of the study and how they are solved, as plain values.

        A change of any other key, or of a heading or label, causes no case to be solved again.
        Options of solvers are not part of it: each solver has its own. The values returned are
        those of a valid study.
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
    def _further_cases_are_complete(self) -> Self:
        names = {factor.name for factor in self.factors}
        if self.reference and set(self.reference) != names:
            raise ValueError(
                f"study {self.name}: reference: give {sorted(names)}, got {sorted(self.reference)}"
            )
        for number, case in enumerate(self.further_cases, start=1):
            if set(case) != names:
                raise ValueError(
                    f"study {self.name}: further_cases, case {number}: give {sorted(names)}, got "
                    f"{sorted(case)}"
                )
        return self

    @model_validator(mode="after")
    def _values_are_possible(self) -> Self:
        levels = {factor.name: factor.levels for factor in self.factors}
        given: list[tuple[str, str, Level]] = [
            *(("factors", name, level) for name, of in levels.items() for level in of),
            *(("fixed", name, level) for name, level in self.fixed.items()),
            *(("reference", name, value) for name, value in self.reference.items()),
            *(("further_cases", k, v) for case in self.further_cases for k, v in case.items()),
            ("load_n", "load_n", self.load_n),
        ]
        for key, name, value in given:
            if name not in RANGES or isinstance(value, MeasuredRubber):
                continue
            if fault := RANGES[name].fault(value):
                raise ValueError(f"study {self.name}: {key}: {name} {fault}")
        return self

    @model_validator(mode="after")
    def _plots_are_of_its_factors(self) -> Self:
        if not isinstance(self.design, SplitPlot):
            return self
        names = {factor.name for factor in self.factors}
        hard, spaced = set(self.design.hard_to_change), set(self.design.log_spaced)
        if stray := sorted((hard | spaced) - names):
            raise ValueError(f"study {self.name}: design names {stray}, which are not its factors")
        if hard == names:
            raise ValueError(
                f"study {self.name}: all factors are hard_to_change; leave at least one to vary on "
                "each whole plot, or use latin_hypercube"
            )
        for factor in self.factors:
            low = min((each for each in factor.levels if isinstance(each, float)), default=1.0)
            if factor.name in spaced and low <= 0.0:
                raise ValueError(
                    f"study {self.name}: log_spaced needs levels of {factor.name} above zero"
                )
        return self

    @model_validator(mode="after")
    def _terms_can_be_read(self) -> Self:
        factors = [factor.name for factor in self.factors]
        if isinstance(self.design, DOptimal):
            parse(self.design.terms, factors)
        if self.terms:
            parse(self.terms, factors)
        for model in self.surfaces:
            terms, through_origin = own_terms(model)
            if terms or through_origin:
                parse(terms, factors, through_origin)
        return self

    @model_validator(mode="after")
    def _surfaces_differ(self) -> Self:
        names = [surface_name(model) for model in self.surfaces]
        names += ["polynomial"] if self.terms else []
        if len(set(names)) < len(names):
            raise ValueError(f"study {self.name}: two surfaces are the same: {names}")
        if self.surfaces and not self.terms:
            raise ValueError(
                f"study {self.name}: surfaces are compared with the polynomial of `terms`, which "
                "are missing"
            )
        return self

    @model_validator(mode="after")
    def _responses_differ(self) -> Self:
        given = [(choice.name, choice.at(self.load_n)) for choice in self.responses]
        if len(set(given)) < len(given):
            raise ValueError(f"study {self.name}: a response is named twice: {given}")
        if self.responses and not self.terms:
            raise ValueError(
                f"study {self.name}: surfaces are fitted to its responses only with `terms`, which "
                "are missing"
            )
        return self

    @model_validator(mode="after")
    def _cases_exist(self) -> Self:
        last = self.number_of_cases()
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

    def number_of_cases(self) -> int:
        """Return how many cases its design has, further ones included."""
        of_design = number_of_cases(self.design, [len(factor.levels) for factor in self.factors])
        return of_design + len(self.further_cases)

    def least_solved_cases(self) -> int:
        """Return the number of solved cases below which no surface is fitted."""
        return len(self.terms) + 1 if self.least_cases is None else self.least_cases

    def needs_ply(self) -> bool:
        """Tell whether one of its surfaces uses the constants of the ply."""
        return any(needs_ply(model) for model in self.surfaces)

    def rubbers(self) -> tuple[str, ...]:
        """Name the tested rubbers that levels or fixed values refer to."""
        levels = [level for factor in self.factors for level in factor.levels]
        levels += list(self.fixed.values())
        return tuple(
            dict.fromkeys(level.rubber for level in levels if isinstance(level, MeasuredRubber))
        )
