"""What the solvers of a study can answer: rounded values, loads, tables, published cases."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

import pandas as pd

from nptcs.campaign.record import read_solver_tables
from nptcs.config.solvers.tyre import TyreGeometry
from nptcs.config.studies.design import FullFactorial
from nptcs.config.studies.study import Factor, MeasuredRubber, Study
from nptcs.design import build_design
from nptcs.errors import InputError
from nptcs.solvers.contract import CaseInputs, Solver, SolverOptions, Status
from nptcs.solvers.registry import load_solver, module_of, read_options
from nptcs.surface.fit import refuse_aliased
from nptcs.tables.published.stiffness import PUBLISHED
from nptcs.terms import parse

Options = Mapping[str, Mapping[str, Any]]


@dataclass(frozen=True)
class Asked:
    """A study with everything that its solvers are given, before the materials are known.

    Parameters
    ----------
    study : Study
    options : mapping
        Options of each of its solvers.
    tyre : TyreGeometry
    design : DataFrame
        `numbered_design` of the study.
    """

    study: Study
    options: Options
    tyre: TyreGeometry
    design: pd.DataFrame

    @classmethod
    def of(cls, study: Study, options: Options, tyre: TyreGeometry) -> Asked:
        """Build the design of a study; see `numbered_design` for what it raises."""
        return cls(study, options, tyre, numbered_design(study, tyre))

    def solvers(self) -> list[tuple[Solver, SolverOptions]]:
        """Return the solvers with their checked options."""
        return solvers_of(self.study, self.options)


def solvers_of(study: Study, options: Options) -> list[tuple[Solver, SolverOptions]]:
    """Return the solvers of a study with their checked options."""
    solvers = [
        (load_solver(module_of(name, options[name])), options[name]) for name in study.solvers
    ]
    return [(solver, read_options(solver, given)) for solver, given in solvers]


def numbered_design(study: Study, tyre: TyreGeometry) -> pd.DataFrame:
    """Build the design of a study before its materials are known.

    Tested rubbers, whose moduli are not known yet, get moduli that differ from all others; of the
    fixed values only the numbers are kept.
    """
    fixed = {k: v for k, v in study.fixed.items() if not isinstance(v, MeasuredRubber)}
    factors = tuple(map(_numbered, study.factors))
    return build_design(study.model_copy(update={"factors": factors, "fixed": fixed}), {}, tyre)


def _numbered(factor: Factor) -> Factor:
    numbers = [level for level in factor.levels if not isinstance(level, MeasuredRubber)]
    above = max(numbers, default=0.0)
    rubbers = len(factor.levels) - len(numbers)
    levels = (*numbers, *(above + 1.0 + 1.7 * number for number in range(rubbers)))
    return factor.model_copy(update={"levels": levels})


def check_loads(asked: Asked) -> Iterator[InputError]:
    """Find loads at which one of the solvers can solve no case."""
    study = asked.study
    for solver, checked in asked.solvers():
        reason = checked.load_fault(study.load_n) if solver.loads_tyre else ""
        if reason:
            yield InputError(
                f"solver '{solver.name}': {reason}",
                "change the load, or leave the solver out of this study",
                column=f"studies.{study.name}.load_n",
                value=study.load_n,
            )


def check_tables(asked: Asked) -> Iterator[InputError]:
    """Find tables of solvers that are missing or cannot be read."""
    for _, checked in asked.solvers():
        try:
            read_solver_tables(checked.tables())
        except InputError as error:
            yield error


def check_rounding(asked: Asked) -> Iterator[InputError]:
    """Find levels that a solver cannot tell apart because it rounds both to the same value."""
    study, design = asked.study, asked.design
    for solver, _ in asked.solvers():
        realised = realised_values(solver, asked)
        merged = [
            f"{name} {' and '.join(f'{one:g}' for one in group)} are both {value:.4g}"
            for name in realised
            for value, group in _merged(design[name], realised[name], study).items()
        ]
        if merged:
            yield InputError(
                f"solver '{solver.name}' rounds its values: {'; '.join(merged)}",
                "choose levels that differ for this solver, or leave it out of this study",
                column=f"studies.{study.name}.factors",
            )
        elif study.terms and solver.loads_tyre and len(realised.columns):
            yield from _aliased(
                study,
                design.assign(**{str(name): realised[name] for name in realised}),
                solver.name,
            )


def realised_values(solver: Solver, asked: Asked) -> pd.DataFrame:
    """Return the values that a solver uses for factors that it rounds: one row per case."""
    names, design = [factor.name for factor in asked.study.factors], asked.design
    if solver.realise is None:
        return pd.DataFrame(index=design.index)
    values = design.drop(columns=["case_id", "case"]).to_dict("records")
    rows = [solver.realise({str(k): v for k, v in row.items()}, asked.tyre) for row in values]
    realised = pd.DataFrame(rows, index=design.index)
    return realised[[name for name in realised if name in names]]


def _merged(given: pd.Series, realised: pd.Series, study: Study) -> dict[float, list[float]]:
    """Return, by realised value, the given values that it replaces and that must differ."""
    groups = {
        float(value): sorted(set(given[realised == value])) for value in sorted(set(realised))
    }
    if isinstance(study.design, FullFactorial) or len(groups) == 1:
        return {value: group for value, group in groups.items() if len(group) > 1}
    return {}


def check_terms(asked: Asked) -> Iterator[InputError]:
    """Find terms that this study cannot estimate, even if every case is solved."""
    study, design = asked.study, asked.design
    if not study.terms:
        return
    terms = len(parse(study.terms, [factor.name for factor in study.factors]))
    if len(design) <= terms:
        yield InputError(
            f"{len(design)} cases are too few for {terms} terms",
            "add levels, or use fewer terms",
            column=f"studies.{study.name}.terms",
        )
        return
    yield from _aliased(study, design)


def _aliased(study: Study, design: pd.DataFrame, solver: str = "") -> Iterator[InputError]:
    names = [factor.name for factor in study.factors]
    polynomial = parse(study.terms, names)
    x = design[names].to_numpy(float)
    middle, half = (x.max(axis=0) + x.min(axis=0)) / 2, (x.max(axis=0) - x.min(axis=0)) / 2
    try:
        refuse_aliased(polynomial.matrix((x - middle) / half), polynomial.names)
    except InputError as error:
        why = f", with the values that solver '{solver}' uses" if solver else ""
        column = f"studies.{study.name}.terms"
        yield InputError(error.message + why, error.remedy, column=column)


def check_calibration_cases(asked: Asked) -> Iterator[InputError]:
    """Find calibration cases for which the archive has no published result."""
    study = asked.study
    if PUBLISHED not in study.solvers or study.rubbers():
        return
    solver, checked = next(one for one in asked.solvers() if one[0].name == PUBLISHED)
    try:
        tables = read_solver_tables(checked.tables())
    except InputError:
        return  # `check_tables` names it
    design = asked.design
    for name, numbers in study.calibration_cases.items():
        for number in numbers:
            case = design[design["case"] == number].iloc[0]
            values = {str(k): float(v) for k, v in case.items() if k not in ("case_id", "case")}
            named = (str(case["case_id"]), values, study.load_n, asked.tyre, checked)
            inputs = CaseInputs(*named, tables=tables)
            result = solver.solve(inputs)
            if result.status != Status.OK:
                yield InputError(
                    f"calibration case {number} of solver '{name}' has no published result: "
                    f"{result.message}",
                    "name cases that are in the archive",
                    column=f"studies.{study.name}.calibration_cases.{name}",
                    value=number,
                )


def rounding_notes(asked: Asked) -> dict[str, str]:
    """Say, by solver, which values it uses instead of given ones: ``spacing_mm 15 → 14.62``."""
    design = asked.design
    notes: dict[str, str] = {}
    for solver, _ in asked.solvers():
        realised = realised_values(solver, asked)
        words = [
            f"{name} {given:g} → {value:.4g}"
            for name in realised
            for given, value in sorted(set(zip(design[name], realised[name], strict=True)))
            if abs(value - given) > 1e-6 * abs(given)
        ]
        if words:
            more = f" and {len(words) - MOST_NOTES} more" if len(words) > MOST_NOTES else ""
            notes[solver.name] = ", ".join(words[:MOST_NOTES]) + more
    return notes


MOST_NOTES = 5
"""Rounded values that are named for each solver."""
