"""Figures drawn as SVG and CSV text, in other processes while this one continues with the page.

A plotting function with its arguments comes in; a function that returns the texts, and waits for
them if they are not ready, goes out. Which figures are kept from an earlier report does not belong
here (`nptcs.report.plots`).
"""

from __future__ import annotations

import importlib
import multiprocessing
import os
import sys
import threading
from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor
from typing import TYPE_CHECKING, Any, NamedTuple

import pandas as pd

from nptcs.language import Language, current_language, language
from nptcs.report.figures.style import data_of, to_svg
from nptcs.report.svg import compact

if TYPE_CHECKING:
    from matplotlib.figure import Figure

DIGITS = 6
"""Significant digits of the numbers that a figure carries."""

LIBRARIES = ("nptcs.report.figures.layout", "nptcs.report.figures.canvas")
"""Modules that import what takes longest to import of all that draws figures."""


class Drawn(NamedTuple):
    """A figure as text.

    Parameters
    ----------
    svg : str
        For the page, without its text alternative.
    csv : str
        The numbers that it shows; empty where it has none.
    """

    svg: str
    csv: str


def drawn(draw: Callable[..., Figure], *args: Any, **kwargs: Any) -> Drawn:
    """Draw a figure and write it as text."""
    figure = draw(*args, **kwargs)
    data = data_of(figure)
    return Drawn(compact(to_svg(figure)), "" if data is None else csv_of(data))


def csv_of(data: pd.DataFrame) -> str:
    """Write the numbers of a figure as CSV text, to `DIGITS` significant digits."""
    return data.to_csv(index=False, float_format=f"%.{DIGITS}g", lineterminator="\n")


class Drawers:
    """Processes that draw figures: forks of this one, made when the first figure is requested.

    Parameters
    ----------
    processes : int
        With one, and on a system other than Linux, figures are drawn in this process.
    """

    def __init__(self, processes: int) -> None:
        self._processes = processes if sys.platform == "linux" else 1
        self._pool: ProcessPoolExecutor | None = None

    def start(self, draw: Callable[..., Figure], *args: Any, **kwargs: Any) -> Callable[[], Drawn]:
        """Start drawing a figure; the returned function waits for it.

        Parameters
        ----------
        draw : callable
            A plotting function of `nptcs.report.figures`.
        *args, **kwargs
            Its arguments; with several processes, they and the function must be picklable.
        """
        if self._processes < 2:
            made = drawn(draw, *args, **kwargs)
            return lambda: made
        if self._pool is None:
            for module in LIBRARIES:  # once for all forks
                importlib.import_module(module)
            self._pool = ProcessPoolExecutor(
                self._processes, multiprocessing.get_context("fork"), _end_with_parent
            )
        return self._pool.submit(_drawn_in, current_language(), draw, args, kwargs).result

    def close(self) -> None:
        """End the processes."""
        if self._pool is not None:
            self._pool.shutdown(cancel_futures=True)


def _drawn_in(words: Language, draw: Callable[..., Figure], args: Any, kwargs: Any) -> Drawn:
    """Draw a figure in the language of the page."""
    with language(words):
        return drawn(draw, *args, **kwargs)


def _end_with_parent() -> None:
    """End this process when the one that it draws for has ended, for whatever reason."""
    threading.Thread(target=_wait_for_parent, daemon=True).start()


def _wait_for_parent() -> None:
    parent = multiprocessing.parent_process()
    if parent is not None:
        parent.join()
        os._exit(1)
