"""Figures as SVG in the page, with their numbers as CSV; drawn figures are kept for reuse.

Drawing takes most of the time of a report. A figure is kept under a name made of everything that
it is drawn from: the plotting function, the code of all figures, its arguments, the version of
matplotlib and the language. Matplotlib itself is imported by the first figure that is drawn.
"""

from __future__ import annotations

import base64
import hashlib
import pickle
import re
import zlib
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from functools import cache
from importlib.metadata import version
from pathlib import Path
from typing import TYPE_CHECKING, ParamSpec

from markupsafe import escape

from nptcs.errors import InputError
from nptcs.files import read_sealed, write_sealed
from nptcs.language import catalogue_digest, current_language, tr
from nptcs.report.blocks import Plot
from nptcs.report.drawing import Drawers, Drawn, drawn

if TYPE_CHECKING:
    from matplotlib.figure import Figure

KIND = "Figure"

P = ParamSpec("P")


class KeptFigures:
    """A folder with one file per figure; those that a report does not use are removed at the end.

    Parameters
    ----------
    folder : Path
        Is made if it does not exist.
    code : str
        Hash of the code that draws figures.
    drawers : Drawers
        They draw the figures that are not kept.
    """

    def __init__(self, folder: Path, code: str, drawers: Drawers) -> None:
        self.folder = folder
        self.code = code
        self.drawers = drawers
        self.used: set[str] = set()
        self.started: dict[str, Callable[[], Drawn]] = {}

    def get(
        self, key: str, draw: Callable[P, Figure], *args: P.args, **kwargs: P.kwargs
    ) -> Callable[[], Drawn]:
        """Return a function that gives a figure: the kept one, or one whose drawing starts now."""
        if (kept := self.read(key)) is not None:
            return lambda: kept
        if key not in self.started:
            self.started[key] = self.drawers.start(draw, *args, **kwargs)
        return self.started[key]

    def finish(self) -> None:
        """Wait for the figures that are being drawn, and keep them."""
        for key, made in self.started.items():
            self.write(key, made())
        self.started.clear()

    def read(self, key: str) -> Drawn | None:
        """Return the figure that is kept under a key; None if there is none or it is damaged."""
        self.used.add(f"{key}.json")
        try:
            kept = read_sealed(self.folder / f"{key}.json", KIND)
            return Drawn(str(kept["svg"]), str(kept["csv"]))
        except (OSError, InputError, KeyError):
            return None

    def write(self, key: str, figure: Drawn) -> None:
        """Keep a figure."""
        write_sealed(self.folder / f"{key}.json", figure._asdict(), KIND)

    def drop_unused(self) -> None:
        """Remove the figures that were not requested."""
        for file in self.folder.glob("*.json"):
            if file.name not in self.used:
                file.unlink(missing_ok=True)


_KEPT: ContextVar[KeptFigures | None] = ContextVar("kept figures", default=None)


@contextmanager
def kept_figures(folder: str | Path, code: str, processes: int = 1) -> Iterator[None]:
    """While the block runs, take figures from a folder, and keep those that are drawn in it.

    Parameters
    ----------
    folder : path
        Is made if it does not exist.
    code : str
        Hash of the code that draws figures: another code draws them anew.
    processes : int
        Number of processes that draw at the same time.
    """
    drawers = Drawers(processes)
    kept = KeptFigures(Path(folder), code, drawers)
    token = _KEPT.set(kept)
    try:
        yield
    finally:
        _KEPT.reset(token)
        drawers.close()
    kept.drop_unused()


def finish_figures() -> None:
    """Wait for the figures of the page that other processes draw."""
    kept = _KEPT.get()
    if kept is not None:
        kept.finish()


def plot(
    alt: str, synthetic: bool, draw: Callable[P, Figure], *args: P.args, **kwargs: P.kwargs
) -> Plot:
    """Start drawing a figure, or take it from those that are kept, and write it for the page.

    Parameters
    ----------
    alt : str
        Text alternative of the figure; its file is named after it.
    synthetic : bool
        Whether it shows synthetic data.
    draw : callable
        A plotting function of `nptcs.report.figures`.
    *args, **kwargs
        Its arguments.
    """
    words = tr("{figure} (synthetic data)", figure=alt) if synthetic else alt
    figure = _figure(draw, *args, **kwargs)

    @cache
    def written() -> tuple[str, str]:
        return labelled(figure().svg, words), packed(figure().csv)

    return Plot(written, alt, file_name(alt), synthetic)


def _figure(draw: Callable[P, Figure], *args: P.args, **kwargs: P.kwargs) -> Callable[[], Drawn]:
    """Return a function that gives a figure, which is kept, being drawn, or drawn here."""
    kept = _KEPT.get()
    key = None if kept is None else figure_key(kept.code, draw, *args, **kwargs)
    if kept is not None and key is not None:
        return kept.get(key, draw, *args, **kwargs)
    made = drawn(draw, *args, **kwargs)
    return lambda: made


def figure_key(
    code: str, draw: Callable[P, Figure], *args: P.args, **kwargs: P.kwargs
) -> str | None:
    """Name a figure by everything that it is drawn from; None if an argument cannot be pickled."""
    try:
        content = pickle.dumps((args, sorted(kwargs.items())), protocol=5)
    except (pickle.PicklingError, TypeError, AttributeError):
        return None
    words = f"{current_language()} {catalogue_digest(current_language())}"
    name = f"{draw.__module__}.{draw.__qualname__} {code} {_library()} {words} ".encode()
    return hashlib.sha256(name + content).hexdigest()


@cache
def _library() -> str:
    """Return the version of the library that draws, without importing it."""
    return version("matplotlib")


def packed(csv: str) -> str:
    """Deflate CSV text and write it in base64, for an attribute of the page; empty for none."""
    if not csv:
        return ""
    packer = zlib.compressobj(9, zlib.DEFLATED, -zlib.MAX_WBITS)
    return base64.b64encode(packer.compress(csv.encode()) + packer.flush()).decode()


def file_name(alt: str) -> str:
    """Name the file of a figure after its text alternative.

    Examples
    --------
    >>> file_name("Stress over strain, series T0 (15 %)")
    'stress-over-strain-series-t0-15'
    """
    return "-".join(re.findall(r"\w+", alt.lower()))[:80]


def labelled(svg: str, words: str) -> str:
    """Give a figure the text that a screen reader speaks."""
    return svg.replace("<svg ", f'<svg role="img" aria-label="{escape(words)}" ', 1)
