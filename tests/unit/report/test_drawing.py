"""Figures drawn by several processes are those that one process draws."""

import sys

import psutil
import pytest
from matplotlib.figure import Figure

from nptcs.errors import InputError
from nptcs.language import language, tr
from nptcs.report.drawing import Drawers
from nptcs.report.figures.style import panel, styled
from nptcs.report.plots import finish_figures, kept_figures, plot


@styled
def line(count: int) -> Figure:
    figure, axes = panel(tr("yes"), "x", "y")
    axes.plot(range(count), range(count))
    return figure


def refused(count: int) -> Figure:
    raise InputError("no figure", value=count)


@pytest.mark.skipif(sys.platform != "linux", reason="figures are drawn in forks on Linux alone")
def test_two_processes_draw_what_one_draws_in_the_language_of_the_page():
    with language("zh"):
        here = [Drawers(1).start(line, count)() for count in (3, 4, 5)]
        drawers = Drawers(2)
        waiting = [drawers.start(line, count) for count in (3, 4, 5)]
        assert len(psutil.Process().children()) >= 2
        assert [one() for one in waiting] == here
    assert "是" in here[0].svg
    drawers.close()


@pytest.fixture
def named(monkeypatch):
    """A name for each figure of this file, whose code is not in a module of the package."""
    monkeypatch.setattr("nptcs.report.plots.figure_key", lambda code, draw, count: f"{code}{count}")


@pytest.mark.usefixtures("named")
@pytest.mark.parametrize("processes", [1, 2])
def test_figures_are_kept_once_they_are_drawn(tmp_path, processes):
    with kept_figures(tmp_path, "code", processes):
        first = plot("a line", False, line, 3)
        again = plot("a line", False, line, 3)
        finish_figures()
    (kept,) = tmp_path.glob("*.json")
    assert first.svg == again.svg
    before = kept.stat().st_mtime_ns
    with kept_figures(tmp_path, "code", processes):
        taken = plot("a line", False, line, 3)
        finish_figures()
    assert taken.svg == first.svg
    assert kept.stat().st_mtime_ns == before


@pytest.mark.parametrize("processes", [1, 2])
def test_what_goes_wrong_in_a_figure_is_reported(processes):
    drawers = Drawers(processes)
    with pytest.raises(InputError, match="no figure"):
        drawers.start(refused, 3)()
    drawers.close()
