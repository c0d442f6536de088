"""Statistics of one sample: mean, scatter, confidence, outlier flag, normal B-basis."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache

import numpy as np
from scipy import stats

from nptcs.arrays import Array
from nptcs.config.materials.reduction import StatisticsSettings

NAN = float("nan")
NOT_NORMAL = 0.05


@cache
def mnr_critical(n: int, significance: float = 0.05) -> float:
    """Critical value of the maximum normed residual of `n` specimens.

    C = (n-1)/√n √(t²/(n-2+t²)) with t = t(1 - α/2n, n-2): CMH-17-1G, 8.3.3.1 and
    table 8.5.7. NaN for n < 3.

    Examples
    --------
    >>> round(mnr_critical(5), 3)
    1.715
    """
    if n < 3:
        return NAN
    t = stats.t.ppf(1 - significance / (2 * n), n - 2)
    return float((n - 1) / np.sqrt(n) * np.sqrt(t**2 / (n - 2 + t**2)))


@cache
def b_basis_factor(n: int, degrees_of_freedom: int | None = None) -> float:
    """One-sided tolerance factor k_B of a normal B-basis value x̄ - k_B s.

    Covers 90 % of the population with 95 % confidence: k_B is the 0.95 quantile of the
    noncentral t distribution with noncentrality z(0.90)√n, divided by √n (CMH-17-1G,
    table 8.5.10). With a standard deviation pooled over groups its degrees of freedom are given.

    Examples
    --------
    >>> round(b_basis_factor(5), 3)
    3.407
    """
    free = n - 1 if degrees_of_freedom is None else degrees_of_freedom
    noncentrality = stats.norm.ppf(0.90) * np.sqrt(n)
    return float(stats.nct.ppf(0.95, free, noncentrality) / np.sqrt(n))


def describe_sample(
    values: Array, names: Sequence[str], settings: StatisticsSettings, allowable: bool = True
) -> tuple[dict[str, object], list[str]]:
    """Statistics of one sample, and remarks on them.

    Parameters
    ----------
    values : ndarray, shape (n,)
        One value per specimen.
    names : sequence of str
        Specimen ids, for the outlier flag.
    settings : StatisticsSettings
        Significance and group sizes.
    allowable : bool
        Whether a B-basis value makes sense: not for a speed of testing or a bending.

    Examples
    --------
    >>> values = np.array([1500.0, 1540.0, 1480.0, 1520.0, 1510.0])
    >>> names = ["T0-1", "T0-2", "T0-3", "T0-4", "T0-5"]
    >>> numbers, remarks = describe_sample(values, names, StatisticsSettings())
    >>> numbers["mean"], round(numbers["standard_deviation"], 2), round(numbers["b_basis"], 1)
    (1510.0, 22.36, 1433.8)
    >>> remarks
    ['B-basis provisional: n = 5 < 18']
    """
    n = len(values)
    mean = float(values.mean()) if n else NAN
    deviation = float(values.std(ddof=1)) if n > 1 else NAN
    half = float(stats.t.ppf(0.975, n - 1)) * deviation / np.sqrt(n) if n > 1 else NAN
    mnr, outliers = _outliers(values, names, mean, deviation, settings.outlier_significance)
    numbers: dict[str, object] = {
        "n": n,
        "mean": mean,
        "standard_deviation": deviation,
        "cv_percent": 100 * deviation / abs(mean) if n > 1 and mean else NAN,
        "ci95_low": mean - half,
        "ci95_high": mean + half,
        "mnr": mnr,
        "mnr_critical": mnr_critical(n, settings.outlier_significance),
        "outlier_specimens": ", ".join(outliers),
        "median": float(np.median(values)) if n else NAN,
    }
    if not allowable:
        return {**numbers, "k_b": NAN, "b_basis": NAN}, []
    basis, notes = _b_basis(values, mean, deviation, settings)
    return {**numbers, **basis}, notes


def _outliers(
    values: Array, names: Sequence[str], mean: float, deviation: float, significance: float
) -> tuple[float, list[str]]:
    """Maximum normed residual, and the specimen that it flags (at most one)."""
    n = len(values)
    if n < 3 or np.ptp(values) == 0:
        return NAN, []
    residuals = np.abs(values - mean) / deviation
    worst = int(np.argmax(residuals))
    flagged = residuals[worst] > mnr_critical(n, significance)
    return float(residuals[worst]), [names[worst]] if flagged else []


def _b_basis(
    values: Array, mean: float, deviation: float, settings: StatisticsSettings
) -> tuple[dict[str, object], list[str]]:
    n = len(values)
    smallest, full = settings.b_basis_minimum_specimens, settings.b_basis_full_specimens
    if n < smallest:
        return {"k_b": NAN, "b_basis": NAN}, [f"no B-basis: n = {n}, at least {smallest}"]
    k_b = b_basis_factor(n)
    notes = [f"B-basis provisional: n = {n} < {full}"] if n < full else []
    if np.ptp(values) > 0:
        p = float(stats.shapiro(values).pvalue)
        if p < NOT_NORMAL:
            notes.append(f"not normally distributed (Shapiro-Wilk p = {p:.2g}): B-basis doubtful")
    basis, words = positive_basis(mean - k_b * deviation, n)
    return {"k_b": k_b, "b_basis": basis}, [*notes, *words]


def positive_basis(basis: float, n: int) -> tuple[float, list[str]]:
    """Return a basis value, or none with the reason where it would not be positive.

    A modulus, strength or strain has no negative lower bound: it says that the sample is too
    small for its scatter, not what the material can do.
    """
    if basis > 0 or basis != basis:
        return basis, []
    return NAN, [f"no B-basis: not above zero, n = {n} is too few for this scatter"]
