"""The solved cases of one study and solver, and any response of them."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
import pandas as pd

from nptcs.arrays import Array
from nptcs.config.studies.goals import ResponseName
from nptcs.config.studies.response import RESPONSE_KINDS, Taken
from nptcs.config.studies.study import Study
from nptcs.errors import InputError
from nptcs.responses.curve import LoadCurve
from nptcs.surface.cases import solved_cases
from nptcs.surface.registry import STIFFNESS as AT_STUDY_LOAD

STIFFNESS = ("secant_stiffness", "tangent_stiffness")


@dataclass(frozen=True)
class StudyResults:
    """Results of a study by one of its solvers.

    Parameters
    ----------
    study : Study
    solver : str
    cases : DataFrame
        Rows of ``cases.csv`` of the study and the solver; failed ones included.
    responses : DataFrame
        `nptcs.tables.tyres.tyre_responses.TyreResponses` of the same cases.
    curves : DataFrame
        `nptcs.tables.tyres.tyre_responses.TyreCurves` of the same cases.
    """

    study: Study
    solver: str
    cases: pd.DataFrame
    responses: pd.DataFrame
    curves: pd.DataFrame

    @property
    def factors(self) -> list[str]:
        """Factors of the study."""
        return [factor.name for factor in self.study.factors]

    @property
    def solved(self) -> pd.DataFrame:
        """Solved cases, factors as the solver realised them, one row per tyre."""
        return solved_cases(self.cases, self.solver, self.factors).table

    @property
    def points(self) -> Array:
        """Factors of the solved cases, shape (m, n)."""
        return self.solved[self.factors].to_numpy(float)

    def at_its_load(self, response: ResponseName) -> ResponseName:
        """Return the response at the study's load if it has no place but needs one."""
        if response.at or RESPONSE_KINDS[response.name].taken is Taken.UNLOADED:
            return response
        return replace(response, at=f"{self.study.load_n:g} N")

    def unit(self, response: ResponseName) -> str:
        """Return the unit of a response."""
        return RESPONSE_KINDS[response.name].unit

    def gives(self, response: ResponseName) -> bool:
        """Tell whether any solved case has a response: ``published`` has only the stiffness."""
        try:
            self.values(response)
        except InputError:
            return False
        return True

    def values(self, response: ResponseName) -> Array:
        """Return a response of the solved cases, NaN where a case lacks it, shape (m,).

        Raises
        ------
        InputError
            For a response that no case has; the message names those that cases have.
        """
        if response.name in STIFFNESS:
            found = pd.Series(dict(self._stiffness(response)), dtype=float)
        else:
            found = self._tabulated(response)
        values: Array = np.asarray(found.reindex(self.solved["case_id"]), dtype=float)
        if not np.isfinite(values).any():
            raise InputError(
                f"no case of study {self.study.name} by {self.solver} has {response}",
                column="decisions",
                value=str(response),
                remedy=self._remedy(response),
            )
        return values

    def with_cases(self, other: StudyResults) -> StudyResults:
        """Return these results and those of further cases of the same study and solver."""
        return replace(
            self,
            cases=pd.concat([self.cases, other.cases], ignore_index=True),
            responses=pd.concat([self.responses, other.responses], ignore_index=True),
            curves=pd.concat([self.curves, other.curves], ignore_index=True),
        )

    def _stiffness(self, response: ResponseName) -> Iterator[tuple[str, float]]:
        at, _, unit = response.at.partition(" ")
        place = float(at)
        solved = self.solved.set_index("case_id")
        if response == self.at_its_load(ResponseName("secant_stiffness")):
            yield from solved[AT_STUDY_LOAD].items()  # type: ignore[misc]
            return
        for case_id, rows in self.curves.groupby("case_id"):
            try:
                curve = LoadCurve(rows["displacement_mm"].to_numpy(), rows["force_n"].to_numpy())
            except ValueError:
                continue
            point = curve.at_load(place) if unit == "N" else curve.at_displacement(place)
            if point is not None:
                secant = response.name == "secant_stiffness"
                yield str(case_id), point.secant_n_per_mm if secant else point.tangent_n_per_mm

    def _tabulated(self, response: ResponseName) -> pd.Series:
        rows = self.responses[self.responses["response"] == response.name]
        if response.at:
            rows = rows[rows["at"] == response.at]
        return rows.drop_duplicates("case_id").set_index("case_id")["value"]

    def _remedy(self, response: ResponseName) -> str:
        if response.name in STIFFNESS:
            return "ask for a load or displacement that the solved curves reach"
        places = sorted({*self.responses[self.responses["response"] == response.name]["at"]} - {""})
        if places:
            return f"it is known at {', '.join(places)}"
        known = self.responses[self.responses["status"] == "ok"]["response"]
        return f"use one of {', '.join(sorted({*known, *STIFFNESS}))}"


def results_of(
    study: Study,
    solver: str,
    cases: pd.DataFrame,
    responses: pd.DataFrame,
    curves: pd.DataFrame,
) -> StudyResults:
    """Take the rows of one study and solver from the tables of a run.

    Raises
    ------
    InputError
        When the study is not solved by that solver.
    """
    if solver not in study.solvers:
        raise InputError(
            f"study {study.name} is not solved by this solver",
            column="decisions.solver",
            value=solver,
            remedy=f"name one of {', '.join(study.solvers)}",
        )
    chosen = [
        table[(table["study"] == study.name) & (table["solver"] == solver)]
        for table in (cases, responses, curves)
    ]
    return StudyResults(study, solver, *chosen)
