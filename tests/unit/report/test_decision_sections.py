"""Sections on uncertainty and decisions, and residual figures: what they show is the tables."""

from dataclasses import replace

import numpy as np
import pandas as pd
import pytest

from nptcs.config.studies.decisions import Decision
from nptcs.report.blocks import Facts, Plots, Text
from nptcs.report.figures.decision import goal_intervals
from nptcs.report.figures.residuals import residual_quantiles, residuals_over_value
from nptcs.report.figures.theme import COLOURS
from nptcs.report.figures.uncertainty import share_bars
from nptcs.report.html import render_report
from nptcs.report.sections.decision import decision_section
from nptcs.report.sections.uncertainty import uncertainty_section
from nptcs.report.tables.sheets import sheets_of
from nptcs.surface.diagnostics.tables import influence_table
from nptcs.tables.catalogue import TABLES
from nptcs.tables.io import check


def table_of(name, *rows):
    columns = list(TABLES[name].contract.to_schema().columns)
    return check(pd.DataFrame(rows).reindex(columns=columns), TABLES[name].contract, name)


ABOUT = {"study": "plate", "solver": "published", "design": "reference"}
PLACE = {"response": "secant_stiffness", "at": "5000 N", "unit": "N/mm"}


@pytest.fixture(scope="module")
def decided(results):
    uncertainty = table_of(
        "uncertainty.csv",
        {
            **ABOUT,
            **PLACE,
            "factors": "spacing_mm 15",
            "nominal": 264.5,
            "mean": 264.4,
            "sd": 2.3,
            "low": 259.9,
            "high": 268.9,
            "confidence_percent": 95.0,
            "interaction_percent": 0.1,
            "bias_mean_percent": 0.24,
            "bias_largest_percent": -1.72,
            "blind_cases": 58,
            "surface": "polynomial",
            "cases": 63,
            "card": "standard_error",
            "note": "",
        },
    )
    parts = [("stated", "shear_band_c10_mpa ± 0.1", 1.9, 72.0), ("tolerance", "T ± 1", 0.6, 28.0)]
    shares = table_of(
        "uncertainty_shares.csv",
        *(
            {
                **ABOUT,
                **PLACE,
                "kind": kind,
                "quantities": what,
                "source": "x",
                "effect_sd": sd,
                "share_percent": share,
            }
            for kind, what, sd, share in parts
        ),
        {**ABOUT, **PLACE, "kind": "not assessed", "quantities": "nu23", "source": "assumed"},
    )
    decisions = table_of(
        "decisions.csv",
        {
            "decision": "stiff",
            "study": "plate",
            "solver": "published",
            "goals": "secant_stiffness at 5000 N = 300 ± 5",
            "with_probability": 0.9,
            "status": "feasible",
            "design": "22 plates, spacing_mm 9.77",
            "plates": 22,
            "probability": 0.93,
            "desirability": 1.0,
            "feasible_percent": 3.2,
            "candidates": 3120,
            "confirmation": "outside",
            "solved_designs": 1,
            "search_cpu_s": 4.0,
            "message": "",
        },
        {
            "decision": "never",
            "study": "plate",
            "solver": "published",
            "goals": "secant_stiffness at 5000 N = 900 ± 5",
            "with_probability": 0.9,
            "status": "infeasible",
            "design": "22 plates",
            "probability": 0.0,
            "desirability": 0.0,
            "feasible_percent": 0.0,
            "candidates": 3120,
            "confirmation": "",
            "solved_designs": 0,
            "message": "out of reach even alone",
        },
    )
    designs = table_of(
        "decision_designs.csv",
        *(
            {
                "decision": "stiff",
                "rank": rank,
                "chosen": rank == 1,
                "design": f"{plates} plates",
                "plates": plates,
                "probability": 0.93,
                "desirability": 1.0,
                "goal": "secant_stiffness at 5000 N = 300 ± 5",
                **PLACE,
                "mean": mean,
                "sd": 2.0,
                "low": mean - 4,
                "high": mean + 4,
                "smallest_accepted": 295.0,
                "largest_accepted": 305.0,
                "goal_probability": 0.93,
            }
            for rank, plates, mean in ((1, 22, 299.0), (2, 21, 298.0))
        ),
    )
    confirmation = table_of(
        "decision_confirmation.csv",
        {
            "decision": "stiff",
            "study": "plate",
            "solver": "published",
            "round": 1,
            "design": "22 plates",
            **PLACE,
            "predicted": 299.0,
            "low": 298.9,
            "high": 299.1,
            "solved": 299.4,
            "difference": -0.4,
            "result": "outside",
            "goal_met": "yes",
            "added": True,
            "wall_time_s": 11.0,
            "message": "",
        },
    )
    named = [
        Decision(name=name, study="plate", solver="published", targets=("K=300±5",))
        for name in ("stiff", "never")
    ]
    return replace(
        results,
        config=results.config.model_copy(
            update={
                "studies": tuple(
                    study.model_copy(
                        update={"decisions": tuple(named) if study.name == "plate" else ()}
                    )
                    for study in results.config.studies
                )
            }
        ),
        tables={
            **results.tables,
            "uncertainty.csv": uncertainty,
            "uncertainty_shares.csv": shares,
            "decisions.csv": decisions,
            "decision_designs.csv": designs,
            "decision_confirmation.csv": confirmation,
        },
    )


def words(section):
    facts = [f for block in section.blocks if isinstance(block, Facts) for f in block.facts]
    texts = [block.text for block in section.blocks if isinstance(block, Text)]
    return " ".join([*texts, *(f"{fact.what}: {fact.result}" for fact in facts)])


def test_the_sections_say_what_the_tables_contain(decided):
    sheets = sheets_of(decided)
    said = words(uncertainty_section(decided, sheets))
    assert "264.4 ± 2.3 N/mm (SD), 95 % interval 259.9 to 268.9; shear band C10 (T-C) 72 %" in said
    assert "Bias, not in the interval: +0.24 % mean, -1.72 % at most, 58 blind cases" in said
    section = decision_section(decided, sheets)
    said = words(section)
    assert "Chosen: 22 plates, plate spacing S\u00a09.77\u00a0mm; it meets all targets" in said
    assert "solved 299.4 N/mm, predicted 299 (298.9 to 299.1): outside; the case was added" in said
    assert "out of reach even alone. Nearest design: 22 plates." in said
    assert [block.kind for block in section.blocks if isinstance(block, Text)] == [
        "heading",
        "ok",
        "heading",
        "bad",
    ]
    drawn = [block for block in section.blocks if isinstance(block, Plots)]
    assert all(block.plots for block in drawn)


def test_a_run_without_decisions_has_neither_section(results):
    sheets = sheets_of(results)
    assert not uncertainty_section(results, sheets).blocks
    assert not decision_section(results, sheets).blocks


def test_the_page_has_both_sections(decided):
    page = render_report(decided)
    assert 'id="uncertainty"' in page
    assert 'id="decision"' in page


def test_figures_show_the_tables(decided):
    shares = decided.tables["uncertainty_shares.csv"].dropna(subset=["share_percent"])
    widths = [bar.get_width() for bar in share_bars(shares, "title").axes[0].patches]
    assert sorted(widths) == [28.0, 72.0]
    figure = goal_intervals(decided.tables["decision_designs.csv"])
    chosen, other = (c.lines[0].get_xdata().tolist() for c in figure.axes[0].containers)
    assert (chosen, other) == ([299.0], [298.0])
    band = figure.axes[0].patches[-1]
    assert (band.get_x(), band.get_x() + band.get_width()) == (295.0, 305.0)


def in_order(points):
    return points[np.lexsort(points.T)]


def test_residual_figures_show_every_case(results):
    surface = results.surfaces["plate"]["published"]
    table = influence_table({"plate": {"published": surface}})
    axes = residuals_over_value(table, "title").axes[0]
    marks = [line.get_xydata() for line in axes.get_lines() if line.get_color() == COLOURS[0]]
    expected = np.column_stack([surface.predict(surface.x), surface.y - surface.predict(surface.x)])
    np.testing.assert_allclose(in_order(np.vstack(marks)), in_order(expected), atol=1e-9)
    line = residual_quantiles(table, "title").axes[0].get_lines()[-1]
    assert len(line.get_xdata()) == 63
    assert (np.diff(line.get_ydata()) >= 0).all()
