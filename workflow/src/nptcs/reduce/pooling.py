"""Groups pooled over tests: the scatter within the groups, and whether their means agree."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import pandas as pd
from scipy import stats

from nptcs.config.reduction import StatisticsSettings
from nptcs.reduce.sample import NAN, b_basis_factor
from nptcs.tables.specimens import Specimen

KEY = ["material", "orientation_deg", "property"]


def pooled_rows(
    properties: pd.DataFrame, sheet: Mapping[str, Specimen], settings: StatisticsSettings
) -> list[dict[str, object]]:
    """Rows of scope "pooled" for the tests that the settings name together.

    Mean over all N specimens; s² = Σ(n_j - 1)s_j²/(N - J) within the J groups; confidence
    interval and B-basis with N - J degrees of freedom (CMH-17 volume 1, 8.3.5). The note gives
    the p-values of equal means (analysis of variance) and of equal variances (Levene about the
    median): where either is below 0.05 the groups should not be pooled, and the row says so.
    """
    included = properties[[sheet[s].include for s in properties["specimen"]]]
    included = included[included["value"].notna()]
    rows = []
    for tests in settings.pool_tests:
        chosen = included[included["test"].isin(tests)]
        for key, group in chosen.groupby(KEY, dropna=False, sort=False):
            parts = [part for _, part in group.groupby("test", sort=False)]
            if len(parts) > 1 and all(len(part) > 1 for part in parts):
                rows.append({**dict(zip(KEY, key, strict=True)), **_pool(parts, settings)})
    return rows


def _pool(parts: list[pd.DataFrame], settings: StatisticsSettings) -> dict[str, object]:
    samples = [part["value"].to_numpy() for part in parts]
    values = np.concatenate(samples)
    n, free = len(values), len(values) - len(samples)
    mean = float(values.mean())
    within = sum(float(((s - s.mean()) ** 2).sum()) for s in samples)
    deviation = float(np.sqrt(within / free))
    half = float(stats.t.ppf(0.975, free)) * deviation / np.sqrt(n)
    allowed = n >= settings.b_basis_minimum_specimens
    k_b = b_basis_factor(n, free) if allowed else NAN
    table = pd.concat(parts)
    return {
        "test": "+".join(table["test"].unique()),
        "unit": table["unit"].iloc[0],
        "n": n,
        "mean": mean,
        "standard_deviation": deviation,
        "cv_percent": 100 * deviation / abs(mean) if mean else NAN,
        "ci95_low": mean - half,
        "ci95_high": mean + half,
        "mnr": NAN,
        "mnr_critical": NAN,
        "outlier_specimens": "",
        "b_basis": mean - k_b * deviation,
        "left_out": "",
        "rule": " | ".join(table["rule"].unique()),
        "range": " | ".join(r for r in table["range"].unique() if r),
        "scope": "pooled",
        "median": float(np.median(values)),
        "reported_statistic": "mean",
        "k_b": k_b,
        "notes": "; ".join(_poolability(samples)),
    }


def _poolability(samples: list[np.ndarray]) -> list[str]:
    if any(np.ptp(sample) == 0 for sample in samples):
        return ["poolability not assessed: a group without scatter"]
    means = float(stats.f_oneway(*samples).pvalue)
    variances = float(stats.levene(*samples, center="median").pvalue)
    notes = [f"equal means p = {means:.2g}, equal variances p = {variances:.2g}"]
    if min(means, variances) < 0.05:
        notes.append("the groups differ: do not pool")
    return notes
