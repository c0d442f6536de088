"""Predicted spokes for a table of designs, with the error that comes from the prediction."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from nptcs.fe.spoke.energy_table import SpokeEnergyTable
from nptcs.ring.gradient import displacement_slopes
from nptcs.ring.kernel.spokes import SpokePolynomial
from nptcs.ring.solution import RingState
from nptcs.ring.surrogate.model import DESIGN, PredictedTable, SpokeSurrogate
from nptcs.ring.tyre import RingTyre


class PredictedSpokes:
    """A `SpokeSource` of predicted tables; a row has the columns of `DESIGN`.

    Parameters
    ----------
    surrogate : SpokeSurrogate
    with_errors : bool
        Whether to give the standard error of each displacement, which takes about as long as
        the ring itself.
    """

    columns: tuple[str, ...] = DESIGN

    def __init__(self, surrogate: SpokeSurrogate, with_errors: bool = True) -> None:
        self.surrogate = surrogate
        self.with_errors = with_errors

    def _predicted(self, row: Mapping[str, Any]) -> PredictedTable:
        return self.surrogate.predict([float(row[name]) for name in DESIGN])

    def table(self, row: Mapping[str, Any]) -> SpokeEnergyTable:
        """Return the predicted table of a row.

        Raises
        ------
        InputError
            If the row lies outside the surrogate's box.
        """
        return self._predicted(row).table

    def displacement_error_mm(
        self, row: Mapping[str, Any], tyre: RingTyre, states: Sequence[RingState], factor: float
    ) -> float:
        """Return the standard error of the last displacement, NaN where it was not requested."""
        if not self.with_errors:
            return float("nan")
        return displacement_error_mm(tyre, states, self._predicted(row), factor)


def displacement_error_mm(
    tyre: RingTyre, states: Sequence[RingState], predicted: PredictedTable, factor: float = 1.0
) -> float:
    """Give the standard error of the last displacement from those of the table's components.

    The displacement's derivatives with respect to the components come from the adjoint; the
    components' errors are independent.

    Parameters
    ----------
    tyre : RingTyre
        Built with the predicted table.
    states : sequence of RingState
        Its path.
    predicted : PredictedTable
    factor : float
        Factor of the spokes' energy with which the tyre was built.
    """
    neighbours = []
    for mode in predicted.modes:
        sides = [
            with_table(tyre, replace(predicted.table, coefficients=coefficients), factor)
            for coefficients in (
                predicted.table.coefficients - mode,
                predicted.table.coefficients + mode,
            )
        ]
        neighbours.append((sides[0], sides[1], 2.0))
    slopes = displacement_slopes(tyre, neighbours, states)
    return float(np.sqrt(np.sum(slopes**2)))


def with_table(tyre: RingTyre, table: SpokeEnergyTable, factor: float = 1.0) -> RingTyre:
    """Return the same ring on other spokes."""
    spokes = SpokePolynomial.of_table(table, factor)
    ring = replace(tyre.ring, coefficients=spokes.coefficients, sides=spokes.sides)
    return replace(tyre, spokes=spokes, ring=ring)
