"""The fitted surfaces of a study by response, solver and name, ready to predict."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pandas as pd
from scipy.special import ndtr

from nptcs.arrays import Array, Mask
from nptcs.errors import InputError
from nptcs.surface.response_surface import ResponseSurface, box, inside_box

STIFFNESS = "vertical_stiffness_n_per_mm"
"""Secant stiffness at the load of the study: the paper's response, of tables 6, 8 and 9."""

ONE_SIGMA = float(ndtr(1.0) - ndtr(-1.0))
"""Confidence of an interval that is one standard error wide to each side."""


@dataclass(frozen=True, order=True)
class Response:
    """A quantity that has one value for each solved tyre.

    Parameters
    ----------
    name : str
        As in the column ``response`` of ``tyre_responses.csv``, or `STIFFNESS`.
    at : str
        Load or displacement with its unit, ``"3000 N"`` or ``"25 mm"``; empty where there is none.
    unit : str
        Unit of the response; ``1`` for a ratio.
    """

    name: str
    at: str = ""
    unit: str = ""

    def __str__(self) -> str:
        return f"{self.name} at {self.at}" if self.at else self.name

    @property
    def load_n(self) -> float | None:
        """Load at which the response is taken; None if it is not taken at a load."""
        number, _, unit = self.at.partition(" ")
        return float(number) if unit == "N" else None

    @classmethod
    def stiffness(cls, load_n: float) -> Response:
        """Secant stiffness at a load, as in ``tyre_responses.csv``."""
        return cls("secant_stiffness", f"{load_n:g} N", "N/mm")


@dataclass(frozen=True)
class Predicted:
    """Predictions of a surface at m points.

    Parameters
    ----------
    mean, standard_error : ndarray of shape (m,)
        In the unit of the response. The standard error is half the width of the 68.3 % prediction
        interval; it is NaN outside the box, where it is not assessed.
    inside : ndarray of shape (m,)
        Whether the point lies in the box of the cases that the surface was fitted to.
    """

    mean: Array
    standard_error: Array
    inside: Mask


@dataclass(frozen=True)
class FittedSurface:
    """A surface with what it predicts and where it comes from.

    Parameters
    ----------
    study, solver, name : str
        Study, solver of its cases, and name of the surface
        (`nptcs.config.studies.surface.surface_name`).
    response : Response
    surface : ResponseSurface
        Its factors are in the values that the solver really used.
    realised : tuple of str
        Factors for which the solver used values other than the given ones.
    not_assessed, failed : int
        Solved cases without this response, and cases without any result: neither is in the fit.
    left_out_rms, left_out_largest : float
        Errors of the predictions of left-out cases, in the unit of the response; NaN if not
        assessed.
    """

    study: str
    solver: str
    name: str
    response: Response
    surface: ResponseSurface
    realised: tuple[str, ...] = ()
    not_assessed: int = 0
    failed: int = 0
    left_out_rms: float = float("nan")
    left_out_largest: float = float("nan")

    @property
    def factors(self) -> tuple[str, ...]:
        """Names of the factors, in the order of the columns of a point."""
        return self.surface.factors

    def box(self) -> dict[str, tuple[float, float]]:
        """Lowest and highest value of each factor among the cases of the fit."""
        lower, upper = box(self.surface.x)
        return {
            name: (float(low), float(high))
            for name, low, high in zip(self.factors, lower, upper, strict=True)
        }

    def predict(self, points: Array | pd.DataFrame) -> Predicted:
        """Predict the response, whatever the kind of the surface.

        Parameters
        ----------
        points : array of shape (m, n) or DataFrame
            Natural units; an array has its columns in the order of `factors`, a table has columns
            of these names, and possibly others.

        Raises
        ------
        InputError
            If a factor is missing or a value is not a finite number.
        """
        x = self._points(points)
        inside = inside_box(self.surface, x)
        low, high = self.surface.interval(x, ONE_SIGMA)
        error = np.where(inside, (high - low) / 2.0, np.nan)
        return Predicted(self.surface.predict(x), error, inside)

    def _points(self, points: Array | pd.DataFrame) -> Array:
        if isinstance(points, pd.DataFrame):
            missing = [name for name in self.factors if name not in points]
            if missing:
                raise InputError(
                    "the points lack a factor of the surface",
                    column=", ".join(missing),
                    remedy=f"give {', '.join(self.factors)}",
                )
            points = points[list(self.factors)].to_numpy(float)
        if not np.isfinite(points).all():
            raise InputError(
                "a point has no number for a factor", remedy="give all factors a value"
            )
        return points


@dataclass(frozen=True)
class SurfaceRegistry:
    """All surfaces of a study.

    Parameters
    ----------
    study : str
    surfaces : tuple of FittedSurface
        The study's stiffness first, then its other responses in the order of the configuration.
    """

    study: str
    surfaces: tuple[FittedSurface, ...]

    def responses(self, solver: str | None = None) -> list[Response]:
        """List the responses that have a surface, each once."""
        found = [s.response for s in self.surfaces if solver in (None, s.solver)]
        return list(dict.fromkeys(found))

    def of_response(self, response: Response) -> list[FittedSurface]:
        """List the surfaces of a response; the unit need not be given."""
        wanted = response.name, response.at
        return [s for s in self.surfaces if (s.response.name, s.response.at) == wanted]

    def find(
        self, response: Response, solver: str | None = None, name: str | None = None
    ) -> FittedSurface:
        """Return the surface of a response that predicts left-out cases best.

        Parameters
        ----------
        response : Response
        solver, name : str, optional
            Only surfaces of this solver, or of this name.

        Raises
        ------
        InputError
            If there is no such surface (the message names the responses that have one), or if no
            solver is given and more than one has the response.
        """
        found = [
            s
            for s in self.of_response(response)
            if solver in (None, s.solver) and name in (None, s.name)
        ]
        if not found:
            asked = ", ".join(filter(None, [str(response), solver, name]))
            there = ", ".join(map(str, self.responses(solver))) or "none"
            raise InputError(
                f"study {self.study} has no such surface",
                value=asked,
                remedy=f"ask for one of these responses: {there}; `responses` of the study adds "
                "others",
            )
        solvers = sorted({s.solver for s in found})
        if len(solvers) > 1:
            raise InputError(
                f"several solvers of study {self.study} have this response",
                value=str(response),
                remedy=f"name one of them: {', '.join(solvers)}",
            )
        return min(found, key=lambda s: np.nan_to_num(s.left_out_rms, nan=np.inf))

    def by_solver(self, response: Response) -> dict[str, dict[str, ResponseSurface]]:
        """Return the surfaces of one response by solver and name."""
        found: dict[str, dict[str, ResponseSurface]] = {}
        for fitted in self.of_response(response):
            found.setdefault(fitted.solver, {})[fitted.name] = fitted.surface
        return found
