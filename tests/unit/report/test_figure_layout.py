"""Every figure of the page: no text covers another or leaves the figure, and it has its numbers."""

from itertools import combinations

import numpy as np
import pandas as pd
import pytest
from matplotlib.text import Text
from matplotlib.transforms import Bbox

from nptcs.language import language
from nptcs.report.figures.canvas import WideCanvas
from nptcs.report.figures.decision import goal_intervals
from nptcs.report.figures.style import data_of, panel, styled
from nptcs.report.html import render_report

TOUCH_PT = 0.75
"""Boxes of text have room around the letters: they may touch by this much (points)."""


def boxes(figure):
    """Text, box (points) and angle of every word that a figure shows."""
    renderer = WideCanvas(figure).get_renderer()
    figure.draw(renderer)
    hidden = {id(label) for axes in figure.axes for label in labels_of_no_tick(axes)}
    return [
        (text.get_text(), text.get_window_extent(renderer), text.get_rotation() % 90)
        for text in figure.findobj(Text)
        if text.get_visible() and text.get_text().strip() and id(text) not in hidden
    ]


def labels_of_no_tick(axes):
    """List labels that lie beyond the ends of their axis: Matplotlib does not draw them."""
    for axis in (axes.xaxis, axes.yaxis):
        low, high = sorted(axis.get_view_interval())
        margin = 1e-9 * (high - low)
        for tick in axis.get_major_ticks():
            if not low - margin <= tick.get_loc() <= high + margin:
                yield from (tick.label1, tick.label2)


def faults(figure):
    """Name the texts of a figure that cover each other or leave it."""
    found, page = boxes(figure), figure.bbox
    outside = [
        f"{words!r} leaves the figure"
        for words, box, _ in found
        if min(box.x0, box.y0) < -1 or box.x1 > page.x1 + 1 or box.y1 > page.y1 + 1
    ]
    covered = [
        f"{one[0]!r} covers {other[0]!r}"
        for one, other in combinations(found, 2)
        if one[2] == other[2] == 0 and overlap(one[1], other[1])  # a turned box says little
    ]
    return outside + covered


def overlap(one, other):
    common = Bbox.intersection(one, other)
    return common is not None and min(common.width, common.height) > TOUCH_PT


@pytest.fixture
def drawn(monkeypatch):
    """Figures that a page draws, measured instead of written."""
    figures = []

    def keep(figure):
        figures.append((faults(figure), data_of(figure), figure))
        return "<svg/>"

    monkeypatch.setattr("nptcs.report.drawing.to_svg", styled(keep))
    return figures


def test_texts_that_cover_each_other_are_found():
    @styled
    def bad():
        figure, axes = panel("title", "x", "y")
        axes.text(0.5, 0.5, "one text", transform=axes.transAxes)
        axes.text(0.52, 0.51, "another", transform=axes.transAxes)
        far = axes.text(0.9, 0.2, "far too long to stay inside", transform=axes.transAxes)
        far.set_in_layout(False)
        return figure

    assert sorted(faults(bad())) == [
        "'far too long to stay inside' leaves the figure",
        "'one text' covers 'another'",
    ]


def test_designs_that_differ_in_every_value_leave_room_for_title_and_axis():
    designs = pd.DataFrame(
        {
            "design": [
                f"{13 + place} plates, spacing_mm {16.54 - place}, thickness_mm 1.2{place}, "
                f"angle_deg 1{place}"
                for place in range(3)
            ],
            "goal": "secant_stiffness at 5000 N = 280 ± 6",
            "response": "secant_stiffness",
            **{"at": "5000 N", "unit": "N/mm", "mean": [280.0, 276.0, 284.0]},
            **{"low": 275.0, "high": 285.0, "chosen": [True, False, False]},
            **{"smallest_accepted": 274.0, "largest_accepted": 286.0},
        }
    )
    assert faults(goal_intervals(designs)) == []


@pytest.mark.parametrize(
    ("run", "code"), [("results", "en"), ("compared", "en"), ("compared", "zh")]
)
def test_no_figure_of_the_page_has_text_over_text(run, code, request, drawn):
    with language(code):
        render_report(request.getfixturevalue(run))
    assert len(drawn) > 15
    found = {figure.axes[0].get_title(loc="left"): bad for bad, _, figure in drawn if bad}
    assert found == {}


def test_every_figure_carries_its_numbers(compared, drawn):
    render_report(compared)
    for _, data, figure in drawn:
        title = figure.axes[0].get_title(loc="left")
        assert isinstance(data, pd.DataFrame), title
        assert len(data), title
        assert not data.select_dtypes(float).apply(np.isinf).any().any(), title
        assert all(axes.get_xlabel() or axes.get_ylabel() for axes in figure.axes), title
        assert title, "a figure without a title"


def test_a_power_of_ten_above_the_axis_lifts_the_title():
    @styled
    def tiny():
        figure, axes = panel("Residuals, a title over the axis", "x", "y")
        axes.plot([0, 1], [0, 3e-12])
        return figure

    figure = tiny()
    assert faults(figure) == []
    axes = figure.axes[0]
    height = axes.bbox.height
    assert faults(figure) == []  # drawn again
    assert axes.bbox.height == pytest.approx(height, abs=1)  # points
    assert axes.yaxis.get_offset_text().get_text() == "1e−12"


@pytest.mark.parametrize("equal", [False, True])
def test_the_axes_take_what_their_words_leave(equal):
    @styled
    def drawn_figure():
        figure, axes = panel("title", "x", "y")
        axes.plot([0, 100], [0, 100], label="a line")
        axes.set_aspect("equal" if equal else "auto")
        figure.legend(loc="outside lower center")
        return figure

    figure = drawn_figure()
    found = {words: box for words, box, _ in boxes(figure)}
    axes, legend = figure.axes[0], found["a line"]
    assert found["x"].y1 < axes.bbox.y0 < found["title"].y0
    assert 0 < legend.y0 < legend.y1 < found["x"].y0
    assert found["y"].x1 < found["80"].x0 < axes.bbox.x0 or equal
    beside = figure.bbox.x1 - axes.bbox.x1, figure.bbox.y1 - found["title"].y1
    assert min(beside) > 0
    if not equal:
        assert max(beside) < 20  # points
