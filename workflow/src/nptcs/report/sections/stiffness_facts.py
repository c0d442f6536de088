"""Where computed stiffness differs from the published one, in words: levels and spokes."""

from __future__ import annotations

import pandas as pd

from nptcs.report.blocks import (
    Fact,
)
from nptcs.report.data import Results
from nptcs.report.factor_labels import factor_labels
from nptcs.report.text import joined
from nptcs.tables.published_stiffness import (
    StiffnessByLevel,
)
from nptcs.tables.spoke_stiffness import DIRECTIONS


def level_facts(results: Results) -> list[Fact]:
    """Say how the signed difference runs with each factor, and which steps go the other way."""
    facts = []
    for study in results.config.studies:
        labels = factor_labels(study)
        table = results.table(StiffnessByLevel)
        rows = table[table["study"] == study.name]
        for (solver, factor), levels in rows.groupby(["solver", "factor"], sort=False):
            label = labels[str(factor)]
            means = ", ".join(
                f"{row.mean_difference_percent:+.1f} % at {row.level:g}"
                for row in levels.itertuples()
            )
            what = f"{label.label} [{label.unit}], study {study.name}, solver {solver}"
            facts.append(Fact(what, f"{means}; {_trend(levels)}", "stiffness_by_level.csv"))
    return facts


def spoke_facts(lines: pd.DataFrame) -> list[Fact]:
    """Say how single spokes differ from table 10, which explains part of the tyre's difference."""
    compared = lines.dropna(subset=[f"{name}_difference_percent" for name in DIRECTIONS])
    facts = []
    for (study, solver), rows in compared.groupby(["study", "solver"], sort=False):
        parts = [
            f"{name} "
            + ", ".join(
                f"{difference:+.1f} % at {c10:g}"
                for difference, c10 in zip(
                    rows[f"{name}_difference_percent"], rows["spoke_c10_mpa"], strict=True
                )
            )
            for name in DIRECTIONS
        ]
        what = (
            f"For comparison, single spokes against table 10, by spoke C10 [MPa], study {study}, "
            f"solver {solver}"
        )
        facts.append(Fact(what, "; ".join(parts), "spoke_stiffness.csv"))
    return facts


def _trend(levels: pd.DataFrame) -> str:
    """Compare the direction of the step from each level to the next."""
    computed, published = (
        levels[f"{kind}_mean_n_per_mm"].to_numpy(float) for kind in ("computed", "published")
    )
    level = levels["level"].to_numpy(float)
    steps = range(len(level) - 1)
    opposite = [
        f"{level[step]:g} to {level[step + 1]:g} ({computed[step + 1] - computed[step]:+.2f} N/mm, "
        f"published {published[step + 1] - published[step]:+.2f})"
        for step in steps
        if (computed[step + 1] - computed[step]) * (published[step + 1] - published[step]) < 0
    ]
    change = (
        f"mean stiffness from lowest to highest level "
        f"{levels['computed_change_percent'].iloc[-1]:+.1f} %, published "
        f"{levels['published_change_percent'].iloc[-1]:+.1f} %"
    )
    if opposite:
        return f"{change}; steps in the other direction than published: {joined(opposite)}"
    return f"{change}; every step has the published direction"
