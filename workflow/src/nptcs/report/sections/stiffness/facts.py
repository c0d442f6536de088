"""Where computed stiffness differs from the published one, in words: levels and spokes."""

from __future__ import annotations

import pandas as pd

from nptcs.language import tr
from nptcs.report.blocks import (
    Fact,
)
from nptcs.report.data import Results
from nptcs.report.factor_labels import factor_labels
from nptcs.report.text import joined
from nptcs.tables.published.stiffness import (
    StiffnessByLevel,
)
from nptcs.tables.tyres.spoke_stiffness import DIRECTIONS


def level_facts(results: Results) -> list[Fact]:
    """Say how the signed difference changes with each factor, and which steps are reversed."""
    facts = []
    for study in results.config.studies:
        labels = factor_labels(study)
        table = results.table(StiffnessByLevel)
        rows = table[table["study"] == study.name]
        for (solver, factor), levels in rows.groupby(["solver", "factor"], sort=False):
            label = labels[str(factor)]
            means = ", ".join(
                tr(
                    "{difference:+.1f} % at {level:g}",
                    difference=row.mean_difference_percent,
                    level=row.level,
                )
                for row in levels.itertuples()
            )
            what = tr(
                "{label} [{unit}], study {name}, solver {solver}",
                label=label.label,
                unit=label.unit,
                name=study.name,
                solver=solver,
            )
            facts.append(Fact(what, f"{means}; {_trend(levels)}", "stiffness_by_level.csv"))
    return facts


def spoke_facts(lines: pd.DataFrame) -> list[Fact]:
    """Say how single spokes differ from table 10, which explains part of the tyre's difference."""
    compared = lines.dropna(subset=[f"{name}_difference_percent" for name in DIRECTIONS])
    facts = []
    for (study, solver), rows in compared.groupby(["study", "solver"], sort=False):
        parts = [
            f"{tr(name)} "
            + ", ".join(
                tr("{difference:+.1f} % at {level:g}", difference=difference, level=c10)
                for difference, c10 in zip(
                    rows[f"{name}_difference_percent"], rows["spoke_c10_mpa"], strict=True
                )
            )
            for name in DIRECTIONS
        ]
        what = tr(
            "For comparison, single spokes against table 10, by spoke C10 [MPa], "
            "study {study}, solver {solver}",
            study=study,
            solver=solver,
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
        tr(
            "{level:g} to {level_2:g} ({computed:+.2f} N/mm, published {published:+.2f})",
            level=level[step],
            level_2=level[step + 1],
            computed=computed[step + 1] - computed[step],
            published=published[step + 1] - published[step],
        )
        for step in steps
        if (computed[step + 1] - computed[step]) * (published[step + 1] - published[step]) < 0
    ]
    change = tr(
        "mean stiffness from lowest to highest level "
        "{computed_change_percent:+.1f} %, published "
        "{published_change_percent:+.1f} %",
        computed_change_percent=levels["computed_change_percent"].iloc[-1],
        published_change_percent=levels["published_change_percent"].iloc[-1],
    )
    if opposite:
        return tr(
            "{change}; steps in the opposite direction to the published ones: {names}",
            change=change,
            names=joined(opposite),
        )
    return tr("{change}; every step goes in the published direction", change=change)
