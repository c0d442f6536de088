"""The response surfaces of one study, one for each solver that answered."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import pandas as pd

from nptcs.errors import InputError
from nptcs.surface.fit import Surface, fit
from nptcs.surface.quality import assess
from nptcs.tables.problems import problems_table

RESPONSE = "vertical_stiffness_n_per_mm"


@dataclass(frozen=True)
class StudySurfaces:
    """What became of the fits of a study.

    Parameters
    ----------
    surfaces : mapping of str to Surface
        By solver; without the solvers whose cases determine no surface.
    quality : mapping of str to mapping of str to float
        How well each of them follows its cases.
    problems : DataFrame
        `nptcs.tables.problems.Problems` of the others.
    """

    surfaces: Mapping[str, Surface]
    quality: Mapping[str, Mapping[str, float]]
    problems: pd.DataFrame


def fit_study(
    cases: pd.DataFrame,
    study: str,
    factors: Sequence[str],
    solvers: Sequence[str],
    terms: Sequence[str],
) -> StudySurfaces:
    """Fit the vertical stiffness of the solved cases, solver by solver.

    Parameters
    ----------
    cases : DataFrame
        `nptcs.tables.cases.Cases` of the study.
    study : str
        Name of the study, for the problems.
    factors, solvers, terms : sequences of str
        As the configuration names them.
    """
    surfaces: dict[str, Surface] = {}
    quality: dict[str, Mapping[str, float]] = {}
    problems = []
    for solver in solvers:
        solved = cases[(cases["solver"] == solver) & (cases["status"] == "ok")]
        try:
            surfaces[solver] = fit(solved, solved[RESPONSE], list(factors), list(terms))
            quality[solver] = assess(surfaces[solver], solved, solved[RESPONSE])
        except InputError as error:
            problems.append(("surface", study, solver, "refused", str(error)))
    return StudySurfaces(surfaces, quality, problems_table(problems))
