"""Terms of a polynomial chosen from those given, with hierarchy kept."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy import linalg

from nptcs.arrays import Array
from nptcs.config.studies.surface import Choice, PolynomialModel
from nptcs.surface.fit import coding, refuse_aliased
from nptcs.surface.kinds.linked import LINKS
from nptcs.surface.response_surface import refuse_unusable
from nptcs.terms import Polynomial

Powers = tuple[int, ...]


@dataclass(frozen=True)
class SelectionStep:
    """One polynomial of the backward selection.

    Parameters
    ----------
    exponents : tuple of tuple of int
        Its terms.
    dropped : str
        The term dropped from the polynomial before it; empty for the first.
    aicc : float
        Corrected Akaike criterion, m log(SSE/m) + 2k + 2k(k+1)/(m-k-1) with k = p + 1.
    press : float
        Sum of squared leave-one-out residuals.
    """

    exponents: tuple[Powers, ...]
    dropped: str
    aicc: float
    press: float


def chosen_terms(polynomial: Polynomial, x: Array, y: Array, model: PolynomialModel) -> Polynomial:
    """Return the polynomial with the smallest criterion among those of `backward_steps`."""
    response = y if model.link == "identity" else LINKS[model.link](y)
    steps = backward_steps(polynomial, x, response, model.choose, model.through_origin)
    best = min(steps, key=lambda step: step.press if model.choose == "press" else step.aicc)
    return Polynomial(polynomial.factors, best.exponents)


def backward_steps(
    polynomial: Polynomial, x: Array, y: Array, choose: Choice, through_origin: bool = False
) -> list[SelectionStep]:
    """Drop one term after another, always the one whose removal makes the criterion smallest.

    Only a term that no remaining one needs as its lower-order relative can be dropped, so every
    polynomial on the way is the same surface in any units; the intercept is kept.

    Parameters
    ----------
    polynomial : Polynomial
        All terms to choose from.
    x, y : ndarray of shape (m, n) and (m,)
        Cases.
    choose : str
        ``press``, or ``aicc`` for everything else.
    through_origin : bool
        As in `nptcs.surface.fit.fit_points`.

    Returns
    -------
    list of SelectionStep
        From all terms down to one.
    """
    refuse_unusable(x, y, polynomial.factors, len(polynomial))
    centre, half = coding(x, through_origin)
    coded = (x - centre) / half
    refuse_aliased(polynomial.matrix(coded), polynomial.names)

    def step(exponents: tuple[Powers, ...], dropped: str) -> SelectionStep:
        matrix = Polynomial(polynomial.factors, exponents).matrix(coded)
        return SelectionStep(exponents, dropped, *_criteria(matrix, y))

    steps = [step(polynomial.exponents, "")]
    while candidates := _free_to_go(steps[-1].exponents, through_origin):
        tried = [
            step(
                tuple(powers for powers in steps[-1].exponents if powers != candidate),
                Polynomial(polynomial.factors, (candidate,)).names[0],
            )
            for candidate in candidates
        ]
        steps.append(min(tried, key=lambda s: s.press if choose == "press" else s.aicc))
    return steps


def _free_to_go(exponents: tuple[Powers, ...], through_origin: bool) -> list[Powers]:
    """List the terms that may be dropped: no other one has them as its lower-order relative."""
    if len(exponents) == 1:
        return []
    return [
        powers
        for powers in exponents
        if (any(powers) or through_origin)
        and not any(
            other != powers and all(high >= low for high, low in zip(other, powers, strict=True))
            for other in exponents
        )
    ]


def _criteria(matrix: Array, y: Array) -> tuple[float, float]:
    """Return AICc (infinite without enough cases) and PRESS of a least-squares fit."""
    q, _ = linalg.qr(matrix, mode="economic")
    residual = y - q @ (q.T @ y)
    left_out = residual / (1 - np.einsum("ij,ij->i", q, q))
    cases, k = len(y), matrix.shape[1] + 1
    if cases - k - 1 <= 0:
        return np.inf, float(left_out @ left_out)
    deviance = cases * float(np.log(max(residual @ residual, np.finfo(float).tiny) / cases))
    return deviance + 2 * k + 2 * k * (k + 1) / (cases - k - 1), float(left_out @ left_out)
