"""How well a response surface follows its cases, and predicts cases that it has not seen."""

from __future__ import annotations

import numpy as np
from sklearn.linear_model import LinearRegression
from sklearn.model_selection import KFold, cross_val_predict

from nptcs.surface.diagnostics.influence import press
from nptcs.surface.fit import Surface


def assess(surface: Surface) -> dict[str, float]:
    """Measure the fit of a polynomial to the cases that it was fitted to.

    Leave-one-out residuals are e/(1 - h) with the leverage h (PRESS); the ten folds are drawn
    with a fixed seed. R² compares with the total sum of squares about the mean, or, through the
    origin, with that about zero.

    Parameters
    ----------
    surface : Surface
        The fitted polynomial.

    Returns
    -------
    dict of str to float
        The number columns of ``surface_quality.csv``.
    """
    x, y = surface.x, surface.y
    matrix = surface.polynomial.matrix(surface.coded(x))
    points, terms = matrix.shape
    residual = y - surface.predict(x)
    squares, predicted = press(surface)
    folds = KFold(n_splits=min(10, points), shuffle=True, random_state=0)
    folded = cross_val_predict(LinearRegression(fit_intercept=False), matrix, y, cv=folds)
    total = float(np.sum(y**2 if surface.through_origin else (y - y.mean()) ** 2))
    r_squared = 1 - float(residual @ residual) / total
    return {
        "points": points,
        "terms": terms,
        "r_squared": r_squared,
        "adjusted_r_squared": 1 - (1 - r_squared) * (points - 1) / (points - terms),
        "leave_one_out_r_squared": predicted,
        "ten_fold_r_squared": 1 - float(np.sum((y - folded) ** 2)) / total,
        "press": squares,
        "residual_sd": surface.residual_sd,
        "largest_residual": float(np.abs(residual).max()),
        "condition_number_natural": float(np.linalg.cond(surface.polynomial.matrix(x))),
        "condition_number_coded": float(np.linalg.cond(matrix)),
    }
