"""The surfaces of one study: for each solver with results, one of every requested kind."""

from __future__ import annotations

import time
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import pandas as pd

from nptcs.config.studies.response import RESPONSE_KINDS
from nptcs.config.studies.study import Study
from nptcs.config.studies.surface import SurfaceModel, describes_stiffness_alone
from nptcs.errors import InputError
from nptcs.surface.cases import SolvedCases, solved_cases
from nptcs.surface.diagnostics.comparison import LeftOut, leave_one_out
from nptcs.surface.fit import Surface
from nptcs.surface.kinds.models import FitCases, fit_surface, models_of
from nptcs.surface.registry import STIFFNESS, FittedSurface, Response, SurfaceRegistry
from nptcs.surface.response_surface import ResponseSurface
from nptcs.tables.problems import Problem, problems_table

RESPONSE = Response(STIFFNESS, unit="N/mm")
"""The response of tables 6, 8 and 9."""

POLYNOMIAL = "polynomial"
"""Name of the surface of the study's own terms: that of tables 6 and 8."""


@dataclass(frozen=True, eq=False)
class SurfaceFit:
    """A surface of a study as it was fitted.

    Parameters
    ----------
    solver, name : str
    response : Response
    surface : ResponseSurface
    cpu_s : float
        Processor time of the fit.
    not_assessed : int
        Solved cases of the solver that do not have the response.
    """

    solver: str
    name: str
    response: Response
    surface: ResponseSurface
    cpu_s: float = 0.0
    not_assessed: int = 0

    @cached_property
    def left_out(self) -> LeftOut:
        """Errors at cases that were left out."""
        return leave_one_out(self.surface)


@dataclass(frozen=True)
class StudySurfaces:
    """The fits of a study.

    Parameters
    ----------
    study : str
    fits : tuple of SurfaceFit
        Without those that the cases do not determine.
    solved : mapping of str to SolvedCases
        What they were fitted to, by solver.
    problems : DataFrame
        `nptcs.tables.problems.Problems` of the fits that were refused.
    """

    study: str
    fits: tuple[SurfaceFit, ...]
    solved: Mapping[str, SolvedCases]
    problems: pd.DataFrame

    def of_stiffness(self) -> list[SurfaceFit]:
        """Return the fits of the stiffness at the study's load."""
        return [fit for fit in self.fits if fit.response == RESPONSE]

    @property
    def polynomials(self) -> dict[str, Surface]:
        """The polynomial of the study's terms and stiffness, by solver."""
        return {
            fit.solver: fit.surface
            for fit in self.of_stiffness()
            if fit.name == POLYNOMIAL and isinstance(fit.surface, Surface)
        }

    def registry(self) -> SurfaceRegistry:
        """Collect the surfaces with what they were fitted to and how they predict."""
        return SurfaceRegistry(
            self.study,
            tuple(
                FittedSurface(
                    study=self.study,
                    solver=fit.solver,
                    name=fit.name,
                    response=fit.response,
                    surface=fit.surface,
                    realised=self.solved[fit.solver].changed,
                    not_assessed=fit.not_assessed,
                    failed=self.solved[fit.solver].failed,
                    left_out_rms=fit.left_out.rms,
                    left_out_largest=fit.left_out.largest,
                )
                for fit in self.fits
            ),
        )


@dataclass(frozen=True)
class _Wanted:
    """What is fitted to the cases of one solver."""

    study: Study
    solver: str
    response: Response
    solved: SolvedCases
    values: pd.Series
    ply: Mapping[str, float] | None


def fit_study(
    cases: pd.DataFrame,
    study: Study,
    ply: Mapping[str, float] | None = None,
    values: pd.DataFrame | None = None,
) -> StudySurfaces:
    """Fit the stiffness of the solved cases and the study's further responses, solver by solver.

    Parameters
    ----------
    cases : DataFrame
        `nptcs.tables.tyres.cases.Cases` of the study.
    study : Study
        Factors, solvers, terms, further surfaces and responses.
    ply : mapping of str to float or None
        Constants of the plates' ply, for surfaces that are built on them.
    values : DataFrame, optional
        `nptcs.tables.tyres.tyre_responses.TyreResponses` of the study, for its further responses.

    Returns
    -------
    StudySurfaces
    """
    factors = [factor.name for factor in study.factors]
    solved = {solver: solved_cases(cases, solver, factors) for solver in study.solvers}
    fits: list[SurfaceFit] = []
    problems: list[Problem] = []
    for response in [RESPONSE, *responses_of(study)]:
        by_solver = {
            solver: _values(response, solved[solver].table, solver, values)
            for solver in study.solvers
        }
        having = [solver for solver, found in by_solver.items() if found.notna().any()]
        # an archive of stiffness has no stress: a response is a problem only if no solver has it
        for solver in having or study.solvers:
            wanted = _Wanted(study, solver, response, solved[solver], by_solver[solver], ply)
            for fitted in _fits(wanted):
                if isinstance(fitted, SurfaceFit):
                    fits.append(fitted)
                else:
                    problems.append(fitted)
    return StudySurfaces(study.name, tuple(fits), solved, problems_table(problems))


def responses_of(study: Study) -> list[Response]:
    """Return the further responses of a study."""
    return [
        Response(choice.name, choice.at(study.load_n), RESPONSE_KINDS[choice.name].unit)
        for choice in study.responses
    ]


def _values(
    response: Response, table: pd.DataFrame, solver: str, values: pd.DataFrame | None
) -> pd.Series:
    """Values of a response of the solved cases; NaN where it was not assessed."""
    if response == RESPONSE:
        return table[STIFFNESS]
    if values is None:
        return pd.Series(float("nan"), index=table.index)
    rows = values[
        (values["solver"] == solver)
        & (values["response"] == response.name)
        & (values["at"] == response.at)
    ]
    return table["case_id"].map(rows.set_index("case_id")["value"])


def _fits(wanted: _Wanted) -> Iterator[SurfaceFit | Problem]:
    """Yield every surface of one response and solver, or the problem row of its refusal."""
    study, response = wanted.study, wanted.response
    known = wanted.values.notna()
    table, y = wanted.solved.table[known], wanted.values[known].to_numpy(float)
    factors = [factor.name for factor in study.factors]
    x = table[factors].to_numpy(float)
    about = [wanted.solver] if response == RESPONSE else [wanted.solver, str(response)]
    lacking = int((~known).sum())
    least = study.least_solved_cases()
    if len(table) < least:
        yield _refusal(study, about, _too_few(wanted, len(table), lacking))
        return
    for name, model in models_of(study).items():
        if not _describes(model, response):
            continue
        start = time.process_time()
        try:
            surface = fit_surface(model, FitCases(x, y, factors, study.terms, wanted.ply))
        except InputError as error:
            yield _refusal(study, about if name == POLYNOMIAL else [*about, name], error)
            continue
        cpu_s = time.process_time() - start
        yield SurfaceFit(wanted.solver, name, response, surface, cpu_s, lacking)


def _describes(model: SurfaceModel, response: Response) -> bool:
    """Tell whether a kind of surface describes a response: the lamination form, a stiffness."""
    return response.unit == "N/mm" or not describes_stiffness_alone(model)


def _too_few(wanted: _Wanted, count: int, lacking: int) -> InputError:
    counts = f"{count} cases solved, {wanted.solved.failed} failed"
    if lacking:
        counts += f", {lacking} without this response"
    return InputError(
        f"too few cases for a surface: {counts}",
        column=f"studies.{wanted.study.name}.least_cases",
        value=wanted.study.least_solved_cases(),
        remedy="see case_coverage.csv for the levels that failed, and solve more cases"
        if wanted.response == RESPONSE
        else "see tyre_responses.csv for why it was not assessed, or leave the response out",
    )


def _refusal(study: Study, about: Sequence[str], error: InputError) -> Problem:
    return ("surface", study.name, ", ".join(about), "refused", str(error))
