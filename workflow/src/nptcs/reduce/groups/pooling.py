"""Groups pooled over tests: the scatter within the groups, and whether they may be pooled."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
import pandas as pd
from scipy import stats

from nptcs.arrays import Array
from nptcs.config.materials.reduction import StatisticsSettings
from nptcs.reduce.groups.counted import counted, of_sensors
from nptcs.reduce.groups.sample import NAN, b_basis_factor, positive_basis
from nptcs.tables.laboratory.specimens import Specimen

KEY = ["material", "orientation_deg", "property"]


def pooled_rows(
    properties: pd.DataFrame, sheet: Mapping[str, Specimen], settings: StatisticsSettings
) -> list[dict[str, object]]:
    """Rows of scope "pooled" for the tests that the settings name together.

    The pooled standard deviation is s_p² = Σ(n_j - 1)s_j²/(N - J) over J groups of N specimens.
    There is a row for each group, with its own mean and k_B for n_j specimens and N - J degrees
    of freedom (the pooled standard deviation method of CMH-17 volume 1), which is right where
    the variances are equal; and a row for all together, with the mean over the N specimens,
    which is right where the means are equal too. The notes give the p-values of both
    (Levene about the median; analysis of variance) and say where they are below 0.05.

    Parameters
    ----------
    properties : DataFrame
        `nptcs.tables.laboratory.properties.PropertiesTable`.
    sheet : mapping of str to Specimen
        Specimens by id; those with include = no do not enter.
    settings : StatisticsSettings
        Which tests are pooled, and the smallest n of a B-basis value.
    """
    included = counted(properties, sheet)
    wanted = included["property"].isin(settings.pool_properties)
    included = included[included["value"].notna() & wanted]
    rows: list[dict[str, object]] = []
    for tests in settings.pool_tests:
        chosen = of_sensors(included[included["test"].isin(tests)], KEY)
        chosen = chosen[chosen["value"].notna()]
        for key, group in chosen.groupby(KEY, dropna=False, sort=False):
            parts = [part for _, part in group.groupby("test", sort=False)]
            if len(parts) > 1 and all(len(part) > 1 for part in parts):
                words = dict(zip(KEY, key, strict=True))
                rows += [{**words, **row} for row in _pool(parts, settings)]
    return rows


def _pool(parts: Sequence[pd.DataFrame], settings: StatisticsSettings) -> list[dict[str, object]]:
    samples = [part["value"].to_numpy() for part in parts]
    free = sum(len(s) for s in samples) - len(samples)
    within = sum(float(((s - s.mean()) ** 2).sum()) for s in samples)
    deviation = float(np.sqrt(within / free))
    p_means, p_variances = poolability(samples)
    words = (
        f"standard deviation pooled over {len(parts)} groups, {free} degrees of freedom; "
        f"equal variances p = {p_variances:.2g}"
    )
    unequal = ["the variances differ: do not pool"] if p_variances < 0.05 else []
    rows = [_row(part, deviation, free, [words, *unequal], settings) for part in parts]
    means = f"equal means p = {p_means:.2g}"
    apart = ["the means differ: one mean for all is wrong"] if p_means < 0.05 else []
    together = pd.concat(parts)
    return [*rows, _row(together, deviation, free, [words, means, *unequal, *apart], settings)]


def poolability(samples: Sequence[Array]) -> tuple[float, float]:
    """p-values of equal means (analysis of variance) and of equal variances (Levene, median).

    NaN where no group has any scatter.
    """
    if all(np.ptp(sample) == 0 for sample in samples):
        return NAN, NAN
    means = float(stats.f_oneway(*samples).pvalue)
    return means, float(stats.levene(*samples, center="median").pvalue)


def _row(
    table: pd.DataFrame,
    deviation: float,
    free: int,
    notes: list[str],
    settings: StatisticsSettings,
) -> dict[str, object]:
    values = table["value"].to_numpy()
    n, mean = len(values), float(values.mean())
    half = float(stats.t.ppf(0.975, free)) * deviation / np.sqrt(n)
    smallest = settings.b_basis_minimum_specimens
    k_b = b_basis_factor(n, free) if free + 1 >= smallest else NAN
    if free + 1 < smallest:
        notes = [*notes, f"no B-basis: {free} degrees of freedom, at least {smallest - 1}"]
    basis, words = positive_basis(mean - k_b * deviation, n)
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
        "b_basis": basis,
        "left_out": "",
        "rule": " | ".join(table["rule"].unique()),
        "range": " | ".join(r for r in table["range"].unique() if r),
        "scope": "pooled",
        "median": float(np.median(values)),
        "reported_statistic": "mean",
        "k_b": k_b,
        "notes": "; ".join([*notes, *words]),
        "group_size": n,
        "not_assessed": "",
    }
