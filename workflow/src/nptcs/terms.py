"""Terms of a response surface: how they are written, evaluated and differentiated.

Examples
--------
>>> parse(["1", "a", "b", "a^2", "a*b"], ["a", "b"]).exponents
((0, 0), (1, 0), (0, 1), (2, 0), (1, 1))
>>> parse(["1", "a^2"], ["a"])
Traceback (most recent call last):
nptcs.errors.InputError: column 'terms': terms of lower order are missing, ...

With centre 3 and half range 2, 5 + 4 c is 5 + 4 (x - 3)/2 = -1 + 2 x:

>>> line = parse(["1", "x"], ["x"])
>>> matrix = coded_to_natural(line, np.array([3.0]), np.array([2.0]))
>>> (matrix @ [5.0, 4.0]).astype(float).round(6).tolist()
[-1.0, 2.0]
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import product
from math import comb, prod
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nptcs.arrays import Array, Index
from nptcs.errors import InputError

_POWER = re.compile(r"^\s*([A-Za-z_]\w*)\s*(?:\^\s*(\d+))?\s*$")


@dataclass(frozen=True)
class Polynomial:
    """A sum of monomials in named factors, without its coefficients.

    Parameters
    ----------
    factors : tuple of str
        Names of the n factors.
    exponents : tuple of tuple of int
        One tuple of n powers for each of the p terms.

    Examples
    --------
    >>> import numpy as np
    >>> polynomial = Polynomial(("a", "b"), ((0, 0), (1, 0), (2, 1)))
    >>> polynomial.names
    ('1', 'a', 'a^2*b')
    >>> polynomial.matrix(np.array([[2.0, 3.0]])).tolist()
    [[1.0, 2.0, 12.0]]
    >>> polynomial.derivative_matrix(np.array([[2.0, 3.0]]), "a").tolist()
    [[0.0, 1.0, 12.0]]
    """

    factors: tuple[str, ...]
    exponents: tuple[tuple[int, ...], ...]

    def __len__(self) -> int:
        return len(self.exponents)

    @property
    def names(self) -> tuple[str, ...]:
        """The terms as text: ``1``, ``thickness_mm``, ``thickness_mm*angle_deg``, …."""
        return tuple(_name(self.factors, powers) for powers in self.exponents)

    def matrix(self, x: NDArray[Any]) -> NDArray[Any]:
        """Evaluate the terms: points of shape (m, n) give a design matrix of shape (m, p)."""
        return _products(x, np.array(self.exponents))

    def derivative_matrix(self, x: Array, factor: str) -> Array:
        """Evaluate ∂(term)/∂(factor): points of shape (m, n) give a matrix of shape (m, p)."""
        axis = self.factors.index(factor)
        powers = np.array(self.exponents)
        lowered = powers.copy()
        lowered[:, axis] = np.maximum(lowered[:, axis] - 1, 0)
        slopes: Array = powers[:, axis] * _products(x, lowered)
        return slopes


def _products(x: NDArray[Any], powers: Index) -> NDArray[Any]:
    """Multiply powers (p, n) of the coordinates of points (m, n): array (m, p).

    Each power is a product: to raise all numbers to all powers takes ten times as long.
    """
    raised = [np.ones_like(x)]
    for _ in range(int(powers.max(initial=0))):
        raised.append(raised[-1] * x)
    by_power = np.stack(raised)
    found = by_power[powers[:, 0], :, 0]
    for axis in range(1, x.shape[1]):
        found = found * by_power[powers[:, axis], :, axis]
    return found.T


def parse(terms: Sequence[str], factors: Sequence[str], through_origin: bool = False) -> Polynomial:
    """Read terms such as ``1``, ``x``, ``x^2``, ``x*y``.

    Parameters
    ----------
    terms : sequence of str
        As written in the configuration.
    factors : sequence of str
        Names of the study's factors.
    through_origin : bool
        The surface has no intercept. Its origin is then intended, so no other term needs its
        lower-order relatives either.

    Returns
    -------
    Polynomial
        In the order given.

    Raises
    ------
    InputError
        For a term that cannot be read, an unknown factor, a term named twice, an intercept in a
        surface through the origin, or a term whose lower-order relatives are missing (the fit in
        coded units and the one in natural units would then be two different surfaces).
    """
    exponents = [_exponents(term, factors) for term in terms]
    polynomial = Polynomial(tuple(factors), tuple(exponents))
    for position, powers in enumerate(exponents):
        if powers in exponents[:position]:
            raise InputError(
                "this term is given twice", column="terms", value=terms[position], remedy="drop one"
            )
    if through_origin:
        if (0,) * len(factors) in exponents:
            raise InputError(
                "a surface through the origin has no intercept",
                column="terms",
                value="1",
                remedy="leave '1' out, or through_origin",
            )
        return polynomial
    missing = _missing_lower_terms(polynomial)
    if missing:
        raise InputError(
            "terms of lower order are missing, so that the surface would depend on the choice of "
            "units",
            column="terms",
            value=list(missing),
            remedy="add these terms",
        )
    return polynomial


def coded_to_natural(
    polynomial: Polynomial, centre: NDArray[Any], half_range: NDArray[Any]
) -> NDArray[Any]:
    """Build the matrix M with b_natural = M b_coded, for c = (x - centre) / half_range.

    Each coded term Π ((x_i - m_i)/h_i)^e_i is expanded by the binomial theorem, in the type of
    the numbers given. Shape (p, p).
    """
    index = {powers: row for row, powers in enumerate(polynomial.exponents)}
    matrix = np.zeros((len(polynomial), len(polynomial)), centre.dtype)
    for column, powers in enumerate(polynomial.exponents):
        for lower in product(*(range(power + 1) for power in powers)):
            weight = prod(
                comb(power, low) * (-middle) ** (power - low) / half**power
                for power, low, middle, half in zip(powers, lower, centre, half_range, strict=True)
            )
            if weight:
                matrix[index[lower], column] = weight
    return matrix


def _exponents(term: str, factors: Sequence[str]) -> tuple[int, ...]:
    """Read one term."""
    powers = [0] * len(factors)
    if term.strip() == "1":
        return tuple(powers)
    for part in term.split("*"):
        match = _POWER.match(part)
        if match is None:
            raise InputError(
                "this term cannot be read",
                column="terms",
                value=term,
                remedy="write '1', 'a', 'a^2' or 'a*b' with factor names",
            )
        name, power = match.group(1), int(match.group(2) or 1)
        if name not in factors:
            raise InputError(
                f"'{name}' is not a factor of the study",
                column="terms",
                value=term,
                remedy=f"use {', '.join(factors)}",
            )
        powers[list(factors).index(name)] += power
    return tuple(powers)


def _missing_lower_terms(polynomial: Polynomial) -> tuple[str, ...]:
    """Name the terms that the expansion of the given ones contains and that are not given."""
    given = set(polynomial.exponents)
    lower = {
        below
        for powers in polynomial.exponents
        for below in product(*(range(power + 1) for power in powers))
    }
    return tuple(_name(polynomial.factors, powers) for powers in sorted(lower - given))


def _name(factors: Sequence[str], powers: Sequence[int]) -> str:
    """Write a term as text."""
    parts = [
        name if power == 1 else f"{name}^{power}"
        for name, power in zip(factors, powers, strict=True)
        if power
    ]
    return "*".join(parts) or "1"
