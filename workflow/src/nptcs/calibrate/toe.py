"""The bias of C10 from a toe that remains in the curves."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from scipy.optimize import least_squares

from nptcs.arrays import Array
from nptcs.calibrate.invariants import NEO_HOOKEAN
from nptcs.calibrate.observations import SMALLEST_NUMBER_OF_POINTS, Observation

TENSION = "rubber_tension"
TOE_SHARE = 0.2


def fit_with_offset(data: Sequence[Observation]) -> tuple[float, float]:
    """Neo-Hookean C10 (MPa) and strain offset ε0 of P = 2 C10 f(λ - ε0), least squares.

    ε0 > 0 means that the curve starts late: a toe that shifts it along the strain axis. Without
    the offset the C10 of the data must be positive.
    """
    stress = np.concatenate([o.stress for o in data])
    root = np.sqrt(np.concatenate([o.weight for o in data]))

    def residual(parameters: Array) -> Array:
        c10, offset = parameters
        shifted = [NEO_HOOKEAN.basis(o.mode, o.stretch - offset)[:, 0] for o in data]
        return root * (c10 * np.concatenate(shifted) - stress)

    start = [NEO_HOOKEAN.solve(data)[0], 0.0]
    solution = least_squares(residual, start, x_scale=[start[0], 0.01], xtol=1e-12, ftol=1e-12)
    return float(solution.x[0]), float(solution.x[1])


def toe_bias(data: Sequence[Observation]) -> list[str]:
    """Say what strain offset the tension curves still show and how it biases C10.

    The offset is fitted above `TOE_SHARE` of the range, where a toe has ended; curvature that
    the neo-Hookean model lacks shows as an offset too, so this is a remark, not a correction.
    """
    tension = [o for o in data if o.mode == TENSION]
    if not tension:
        return []
    plain = float(NEO_HOOKEAN.solve(tension)[0])
    above = [_above_toe(o) for o in tension]
    if min(len(o.stress) for o in above) < SMALLEST_NUMBER_OF_POINTS:
        return ["toe: not assessed, too few points above it"]
    if NEO_HOOKEAN.solve(above)[0] <= 0:
        return ["toe: not assessed, the curves carry no tension above it"]
    c10, offset = fit_with_offset(above)
    if c10 <= 0:
        return ["toe: not assessed, a free strain offset leaves no stiffness"]
    return [
        f"toe or curvature: with a free strain offset of {100 * offset:.3g} % the neo-Hookean "
        f"C10 is {c10:.4g} MPa; without it {100 * (plain / c10 - 1):+.2g} %"
    ]


def _above_toe(data: Observation) -> Observation:
    kept = data.stretch - 1 >= TOE_SHARE * (data.stretch[-1] - 1)
    return replace(
        data, stretch=data.stretch[kept], stress=data.stress[kept], weight=data.weight[kept]
    )
