"""How well a surrogate predicts spokes that it has not seen, judged by the tyre's displacement."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from nptcs.arrays import Array
from nptcs.config.solvers.ring import RingOptions
from nptcs.config.solvers.tyre import TyreGeometry
from nptcs.fe.spoke.energy_table import SpokeEnergyTable
from nptcs.ring.solution import RingError, RingState, press_through_loads
from nptcs.ring.surrogate.model import SpokeSurrogate
from nptcs.ring.surrogate.source import displacement_error_mm
from nptcs.ring.tyre import RingTyre, ring_tyre

FOLDS = 10
LOADS_N = (1500.0, 3000.0, 4000.0, 5000.0)


@dataclass(frozen=True)
class LeftOutSpokes:
    """Errors of the displacement on predicted spokes, shape (spokes, loads).

    Parameters
    ----------
    percent : ndarray
        Error of the displacement on the predicted spoke relative to that on the computed one; NaN
        where a spoke leaves its table below the load.
    standard_errors : ndarray of shape (spokes,)
        Error at the last load in standard errors of the prediction.
    edge : ndarray of shape (spokes,)
        Whether the spoke is on a face of the box of the others or outside it, so that its
        prediction is an extrapolation.
    """

    percent: Array
    standard_errors: Array
    edge: Array

    def rms(self, rows: Array | None = None) -> float:
        """Root mean square over spokes and loads, per cent."""
        chosen = self.percent if rows is None else self.percent[rows]
        return float(np.sqrt(np.nanmean(chosen**2)))

    def largest(self, rows: Array | None = None) -> float:
        """Largest error in size, per cent."""
        chosen = self.percent if rows is None else self.percent[rows]
        return float(np.nanmax(np.abs(chosen)))

    def worst(self) -> int:
        """Row of the spoke with the largest error in size."""
        return int(np.argmax(np.nan_to_num(np.abs(self.percent)).max(axis=1)))


def left_out_spokes(
    surrogate: SpokeSurrogate,
    tyre: TyreGeometry,
    options: RingOptions,
    band_c10_mpa: float = 5.0,
    seed: int = 0,
) -> LeftOutSpokes:
    """Leave out a tenth of the spokes at a time; the kernels are kept, the rest is fitted again."""
    count = len(surrogate.tables)
    fold = np.random.default_rng(seed).permutation(np.arange(count) % FOLDS)
    percent = np.full((count, len(LOADS_N)), np.nan)
    errors, edge = np.full(count, np.nan), np.zeros(count, dtype=bool)
    for number in range(FOLDS):
        out = np.flatnonzero(fold == number)
        other = surrogate.without(out.tolist())
        for spoke in out:
            design = surrogate.designs[spoke]
            edge[spoke] = bool(((design <= other.low) | (design >= other.high)).any())
            predicted = other.predict_anywhere(design)
            true = _states(tyre, surrogate.tables[spoke], band_c10_mpa, options)
            guess = _states(tyre, predicted.table, band_c10_mpa, options)
            if true is None or guess is None:
                continue
            exact, found = (_rises(states) for _, states in (true, guess))
            percent[spoke] = 100.0 * (found / exact - 1.0)
            own = displacement_error_mm(*guess, predicted)
            errors[spoke] = (found[-1] - exact[-1]) / own if own > 0 else np.nan
    return LeftOutSpokes(percent, errors, edge)


def _states(
    tyre: TyreGeometry, table: SpokeEnergyTable, band_c10_mpa: float, options: RingOptions
) -> tuple[RingTyre, Sequence[RingState]] | None:
    built = ring_tyre(tyre, table, band_c10_mpa, options)
    try:
        return built, press_through_loads(built, LOADS_N)
    except RingError:
        return None


def _rises(states: Sequence[RingState]) -> Array:
    return np.array([state.rise_mm for state in states if state.force_n in LOADS_N])
