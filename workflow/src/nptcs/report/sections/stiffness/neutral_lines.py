"""Neutral lines of the band in figures and words: figure 14 of the paper."""

from __future__ import annotations

import pandas as pd

from nptcs.language import tr
from nptcs.report.blocks import (
    Listing,
    PageBlock,
    Plot,
    Plots,
    Text,
)
from nptcs.report.data import Results
from nptcs.report.figures.published_stiffness import (
    DISPLACEMENTS,
    neutral_lines,
)
from nptcs.report.plots import plot
from nptcs.report.sections.stiffness.compared_cases import rests_on_synthetic, solver_order
from nptcs.report.text import joined
from nptcs.tables.tyres.neutral_line import NeutralLine


def line_blocks(results: Results) -> list[PageBlock]:
    """Build the figures and the words on neutral lines, and name the cases that have none."""
    lines = results.table(NeutralLine)
    missing = [case_id for case_id in _line_cases(results) if case_id not in set(lines["case_id"])]
    blocks: list[PageBlock] = []
    if missing:
        blocks.append(Text(tr("No solver gave a neutral line for {names}.", names=joined(missing))))
    return blocks if lines.empty else [*blocks, *_drawn_lines(results)]


def _line_cases(results: Results) -> list[str]:
    """Name the cases whose neutral lines the configuration requests."""
    return [
        str(row.case_id)
        for study in results.config.studies
        for row in results.designs[study.name].itertuples()
        if row.case in study.neutral_line_cases
    ]


def _drawn_lines(results: Results) -> list[PageBlock]:
    lines = results.table(NeutralLine)
    tyre = results.config.tyre
    middle = (tyre.inner_wire_diameter_mm + tyre.outer_wire_diameter_mm) / 4
    plots: list[Plot] = []
    sentences: list[str] = []
    for (study, case_id), rows in lines.groupby(["study", "case_id"], sort=False):
        synthetic = rests_on_synthetic(results, results.config.study(str(study)), rows)
        title = f"{case_id}, {rows['load_n'].iloc[0]:g} N"
        for column, label in DISPLACEMENTS.items():
            given = (rows, column, title, solver_order(results), synthetic)
            plots.append(
                plot(
                    tr("{label} of {case_id} against θ", label=tr(label), case_id=case_id),
                    synthetic,
                    neutral_lines,
                    *given,
                )
            )
        sentences += line_words(rows)
    return [
        Plots(
            tr(
                "Displacement of the band's neutral line relative to the rim (figure 14 of the "
                "paper), by every solver that computes it. Finite elements: the middle between "
                "the wire layers, radius {middle:g} mm, all spokes lean the same way, so the two "
                "sides differ; load-bearing model: the ring of radius {band_radius_mm:g} mm, the "
                "same on both sides.",
                middle=middle,
                band_radius_mm=tyre.band_radius_mm,
            ),
            tuple(plots),
            shown=len(DISPLACEMENTS),
        ),
        Listing(tr("What the neutral lines show"), tuple(sentences)),
    ]


def line_words(rows: pd.DataFrame) -> list[str]:
    """Say for each solver how deep, how far out and how far along the neutral line goes."""
    sentences = []
    for solver, line in rows.groupby("solver", sort=False):
        inward, outward = (
            line.iloc[place] for place in (line["radial_mm"].argmin(), line["radial_mm"].argmax())
        )
        along = line["tangential_mm"]
        sentences.append(
            tr(
                "{solver}, {case_id}: radially from {inward:+.2f} mm at θ = "
                "{inward_theta:.1f}° to {outward:+.2f} mm at θ = {outward_theta:.1f}°; "
                "tangentially from {lowest:+.2f} to {highest:+.2f} mm.",
                solver=solver,
                case_id=line["case_id"].iloc[0],
                inward=inward["radial_mm"],
                inward_theta=inward["theta_deg"],
                outward=outward["radial_mm"],
                outward_theta=outward["theta_deg"],
                lowest=along.min(),
                highest=along.max(),
            )
        )
    return sentences
