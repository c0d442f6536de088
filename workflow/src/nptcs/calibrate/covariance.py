"""Covariance of constants that are means over specimens, some of them shared."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import pandas as pd

from nptcs.arrays import Array
from nptcs.tables.laboratory.material_card import Covariance

RULE = (
    "covariance of the means from the specimens' scatter; between constants of the same "
    "specimens: sample correlation of the {shared} shared specimens; between constants of "
    "different specimens: zero, the specimens are independent draws (an error common to all, "
    "e.g. of the load cell or the thickness gauge, is not in it)"
)


def covariance_of_means(
    samples: Mapping[str, pd.Series], units: Mapping[str, str]
) -> Covariance | None:
    """Covariance matrix of the means of several properties.

    For means over n_a and n_b specimens that share n_ab of them,
    cov(x̄_a, x̄_b) = n_ab/(n_a n_b) · r_ab s_a s_b: only shared specimens correlate. r_ab is the
    sample correlation over the shared specimens (at least three; fewer give no estimate and
    count as zero).

    Parameters
    ----------
    samples : mapping of str to Series
        Values by specimen id, one Series per constant.
    units : mapping of str to str
        Unit of each constant.

    Returns
    -------
    Covariance or None
        For the constants with at least two specimens; None if there are none.
    """
    names = [name for name, values in samples.items() if len(values) > 1]
    if not names:
        return None
    errors = np.array([samples[n].std(ddof=1) / np.sqrt(len(samples[n])) for n in names])
    correlation, shared = _correlation_of_means([samples[name] for name in names])
    matrix = correlation * np.outer(errors, errors)
    specimens = dict.fromkeys(s for name in names for s in samples[name].index)
    return Covariance(
        names=tuple(names),
        units=tuple(units[name] for name in names),
        rule=RULE.format(shared=shared),
        specimens=tuple(specimens),
        matrix=tuple(tuple(float(x) for x in row) for row in matrix),
    )


def _correlation_of_means(samples: list[pd.Series]) -> tuple[Array, str]:
    correlation = np.eye(len(samples))
    counts = set()
    for i, a in enumerate(samples):
        for j, b in enumerate(samples[:i]):
            common = a.index.intersection(b.index)
            x, y = a[common].to_numpy(), b[common].to_numpy()
            if len(common) < 3 or np.ptp(x) == 0 or np.ptp(y) == 0:
                continue
            counts.add(len(common))
            r = np.corrcoef(x, y)[0, 1] * len(common) / np.sqrt(len(a) * len(b))
            correlation[i, j] = correlation[j, i] = r
    return correlation, " or ".join(str(count) for count in sorted(counts)) or "0"
