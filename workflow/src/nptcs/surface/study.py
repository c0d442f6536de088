"""The surfaces of one study: for each solver with results, one of every kind that is asked for."""

from __future__ import annotations

import time
from collections.abc import Mapping
from dataclasses import dataclass

import pandas as pd

from nptcs.config.study import Study
from nptcs.errors import InputError
from nptcs.surface.cases import SolvedCases, solved_cases
from nptcs.surface.fit import Surface
from nptcs.surface.models import Cases, fit_model, models_of
from nptcs.surface.response_surface import ResponseSurface
from nptcs.tables.problems import problems_table

RESPONSE = "vertical_stiffness_n_per_mm"
POLYNOMIAL = "polynomial"
"""Name of the surface of the study's own terms: that of tables 6 and 8."""


@dataclass(frozen=True)
class StudySurfaces:
    """The fits of a study.

    Parameters
    ----------
    models : mapping of str to mapping of str to ResponseSurface
        By solver and name; without those that the cases do not determine.
    solved : mapping of str to SolvedCases
        What they were fitted to, by solver.
    fit_cpu_s : mapping of (str, str) to float
        Processor time of each fit, by solver and name.
    problems : DataFrame
        `nptcs.tables.problems.Problems` of the fits that were refused.
    """

    models: Mapping[str, Mapping[str, ResponseSurface]]
    solved: Mapping[str, SolvedCases]
    fit_cpu_s: Mapping[tuple[str, str], float]
    problems: pd.DataFrame

    @property
    def polynomials(self) -> dict[str, Surface]:
        """The polynomial of the study's terms, by solver."""
        return {
            solver: surface
            for solver, named in self.models.items()
            if isinstance(surface := named.get(POLYNOMIAL), Surface)
        }


def fit_study(
    cases: pd.DataFrame, study: Study, ply: Mapping[str, float] | None = None
) -> StudySurfaces:
    """Fit the vertical stiffness of the solved cases, solver by solver.

    Parameters
    ----------
    cases : DataFrame
        `nptcs.tables.cases.Cases` of the study.
    study : Study
        Factors, solvers, terms and further surfaces.
    ply : mapping of str to float or None
        Constants of the plates' ply, for surfaces that are made of them.

    Returns
    -------
    StudySurfaces
    """
    factors = [factor.name for factor in study.factors]
    models: dict[str, dict[str, ResponseSurface]] = {}
    solved: dict[str, SolvedCases] = {}
    times: dict[tuple[str, str], float] = {}
    problems = []
    for solver in study.solvers:
        solved[solver] = solved_cases(cases, solver, factors)
        table = solved[solver].table
        x, y = table[factors].to_numpy(float), table[RESPONSE].to_numpy(float)
        models[solver] = {}
        least = study.least_solved_cases()
        if len(table) < least:
            counts = f"{len(table)} cases solved, {solved[solver].failed} failed"
            why = InputError(
                f"no surface from so few cases: {counts}",
                column=f"studies.{study.name}.least_cases",
                value=least,
                remedy="see case_coverage.csv for the levels that failed, and solve more cases",
            )
            problems.append(("surface", study.name, solver, "refused", str(why)))
            continue
        for name, model in models_of(study).items():
            start = time.process_time()
            try:
                surface = fit_model(model, Cases(x, y, factors, study.terms, ply))
            except InputError as error:
                about = solver if name == POLYNOMIAL else f"{solver}, {name}"
                problems.append(("surface", study.name, about, "refused", str(error)))
                continue
            models[solver][name] = surface
            times[solver, name] = time.process_time() - start
    return StudySurfaces(models, solved, times, problems_table(problems))
