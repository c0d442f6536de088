"""Data of the workbook's charts: lines of the result tables and curves, thinned for drawing.

Nothing is computed: each line is a selection of rows of a table or of a specimen's curve.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import pandas as pd

from nptcs.arrays import Array
from nptcs.language import tr
from nptcs.report.data import Results
from nptcs.report.factor_labels import factor_labels
from nptcs.tables.analysis.sobol import MainEffects
from nptcs.tables.laboratory.hyperelastic import RangeTable
from nptcs.tables.published.stiffness import StiffnessAgainstPublished
from nptcs.tables.tyres.neutral_line import NeutralLine
from nptcs.tables.tyres.spoke_stiffness import SpokeCurves
from nptcs.tables.tyres.tyre_responses import TyreCurves

MOST_POINTS = 120
"""Points of a line that a chart draws; a curve of a specimen has thousands."""

MOST_LINES = 7
"""Most lines of a chart that colours can tell apart."""


@dataclass(frozen=True)
class ChartLine:
    """One line of a chart: name, x and y of shape (m,), and whether it only guides the eye."""

    name: str
    x: Array
    y: Array
    guide: bool = False


@dataclass(frozen=True)
class ChartData:
    """One chart.

    Parameters
    ----------
    title, x_title, y_title : str
        The axes with their units.
    lines : tuple of ChartLine
    source : str
        File from whose rows the lines are taken.
    points : bool
        Whether only marks are drawn, without lines between them.
    synthetic : bool
        Whether it rests on synthetic specimens.
    """

    title: str
    x_title: str
    y_title: str
    lines: tuple[ChartLine, ...]
    source: str
    points: bool = False
    synthetic: bool = False


def charts_of(results: Results) -> list[ChartData]:
    """Return the charts of a run, from material to tyre; those without lines are left out."""
    found = [
        *_specimens(results),
        *_rubber_ranges(results),
        *_spokes(results),
        *_tyres(results),
        *_main_effects(results),
        *_against_published(results),
        *_neutral_lines(results),
    ]
    return [chart for chart in found if chart.lines]


def _specimens(results: Results) -> Iterator[ChartData]:
    for series, specimens in results.series().items():
        shown = [s for s in specimens if s.include and s.specimen in results.curves][:MOST_LINES]
        lines = [
            _line(s.specimen, results.curves[s.specimen], "strain_axial", "stress_mpa")
            for s in shown
        ]
        yield ChartData(
            tr("Specimens {series}: stress against strain", series=series),
            tr("nominal strain [1]"),
            tr("nominal stress [MPa]"),
            tuple(line for line in lines if len(line.x)),
            "results/1_ingest/*.csv",
            synthetic=any(s.origin == "synthetic" for s in shown),
        )


def _rubber_ranges(results: Results) -> Iterator[ChartData]:
    table = results.table(RangeTable)
    all_specimens = table[table["specimen"] == "all"]
    lines = [
        _line(str(name), rows, "strain_high", "c10_mpa")
        for name, rows in all_specimens.groupby("rubber", sort=False)
    ]
    yield ChartData(
        tr("C10 against the strain range of the fit, all specimens"),
        tr("strain range of the fit from 0 to [1]"),
        "C10 [MPa]",
        tuple(lines[:MOST_LINES]),
        "c10_against_range.csv",
        synthetic=results.rubbers_synthetic,
    )


def _spokes(results: Results) -> Iterator[ChartData]:
    for (study, solver), rows in results.table(SpokeCurves).groupby(["study", "solver"]):
        lines = [
            _line(tr("spoke C10 {c10} MPa", c10=f"{c10:g}"), curve, "displacement_mm", "force_n")
            for c10, curve in rows.groupby("spoke_c10_mpa")
        ]
        yield ChartData(
            tr(
                "Single spokes: force against displacement ({study}, {solver})",
                study=study,
                solver=solver,
            ),
            tr("displacement [mm]"),
            tr("force [N]"),
            tuple(lines[:MOST_LINES]),
            "spoke_curves.csv",
            synthetic=results.study_is_synthetic(results.config.study(str(study)), str(solver)),
        )


def _tyres(results: Results) -> Iterator[ChartData]:
    """Softest, middle and stiffest tyre of each study and solver."""
    for (study, solver), rows in results.table(TyreCurves).groupby(["study", "solver"], sort=False):
        lines = [
            _line(str(case), curve, "displacement_mm", "force_n")
            for case, curve in rows.groupby("case_id", sort=False)
        ]
        lines.sort(key=lambda line: line.y[-1] / line.x[-1])
        chosen = [lines[place] for place in sorted({0, len(lines) // 2, len(lines) - 1})]
        yield ChartData(
            tr(
                "Tyres {study}, {solver}: softest, middle and stiffest of {count}",
                study=study,
                solver=solver,
                count=len(lines),
            ),
            tr("vertical displacement [mm]"),
            tr("vertical load [N]"),
            tuple(chosen),
            "tyre_curves.csv",
            synthetic=results.study_is_synthetic(results.config.study(str(study)), str(solver)),
        )


def _main_effects(results: Results) -> Iterator[ChartData]:
    table = results.table(MainEffects)
    labels = {
        (study.name, name): str(label)
        for study in results.config.studies
        for name, label in factor_labels(study).items()
    }
    table = table[(table["surface"] == "polynomial") & (table["inputs"] == "uniform")]
    for (study, factor), rows in table.groupby(["study", "factor"], sort=False):
        solvers = rows.groupby("solver", sort=False)
        lines = [_line(str(name), one, "value", "effect_n_per_mm") for name, one in solvers]
        yield ChartData(
            tr("Main effect on the vertical stiffness ({study})", study=study),
            labels[str(study), str(factor)],
            tr("effect [N/mm]"),
            tuple(lines[:MOST_LINES]),
            "main_effects.csv",
            synthetic=results.table_is_synthetic(rows),
        )


def _against_published(results: Results) -> Iterator[ChartData]:
    table = results.table(StiffnessAgainstPublished)
    x, y = "published_stiffness_n_per_mm", "computed_stiffness_n_per_mm"
    for study, rows in table.dropna(subset=[x, y]).groupby("study", sort=False):
        lines = [_line(str(name), one.sort_values(x), x, y) for name, one in rows.groupby("solver")]
        ends = np.array([rows[x].min(), rows[x].max()])
        yield ChartData(
            tr("Computed against published stiffness ({study})", study=study),
            tr("published [N/mm]"),
            tr("computed [N/mm]"),
            (*lines[: MOST_LINES - 1], ChartLine(tr("equal"), ends, ends, guide=True)),
            "stiffness_against_published.csv",
            points=True,
            synthetic=results.table_is_synthetic(rows),
        )


def _neutral_lines(results: Results) -> Iterator[ChartData]:
    groups = results.table(NeutralLine).groupby(["study", "case_id"], sort=False)
    for (study, case), rows in groups:
        lines = [
            _line(str(solver), one, "theta_deg", "radial_mm")
            for solver, one in rows.groupby("solver", sort=False)
        ]
        yield ChartData(
            tr("Radial displacement of the band's neutral line ({case})", case=case),
            tr("angle from the contact [°]"),
            tr("radial displacement [mm]"),
            tuple(lines[:MOST_LINES]),
            "neutral_line.csv",
            synthetic=results.study_is_synthetic(results.config.study(str(study))),
        )


def _line(name: str, table: pd.DataFrame, x: str, y: str) -> ChartLine:
    """Take two columns, at most `MOST_POINTS` rows, without those that lack a value."""
    kept = table[[x, y]].dropna()
    if len(kept) > MOST_POINTS:
        places = np.unique(np.linspace(0, len(kept) - 1, MOST_POINTS).round().astype(int))
        kept = kept.iloc[places]
    return ChartLine(name, kept[x].to_numpy(float), kept[y].to_numpy(float))
