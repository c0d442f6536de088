"""Figures as SVG in the page, with their numbers as CSV; figures drawn before are kept.

Drawing takes most of the time of a report. A figure is kept under a name made of everything that
it is drawn from: the plotting function with its code, its arguments and the version of matplotlib.
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
from pathlib import Path
from typing import ParamSpec

import matplotlib as mpl
import pandas as pd
from markupsafe import escape
from matplotlib.figure import Figure

from nptcs.errors import InputError
from nptcs.files import read_sealed, write_sealed
from nptcs.language import catalogue_digest, current_language
from nptcs.provenance import code_hash
from nptcs.report.blocks import Plot
from nptcs.report.figures.style import data_of, to_svg
from nptcs.report.svg import compact

KIND = "Figure"
DIGITS = 6
"""Significant digits of the numbers that a figure carries."""

P = ParamSpec("P")


class KeptFigures:
    """A folder with one file per figure; those that a report does not use go in the end.

    Parameters
    ----------
    folder : Path
        Is made if it does not exist.
    """

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.used: set[str] = set()

    def read(self, key: str) -> tuple[str, str] | None:
        """Return the SVG and the CSV text kept under a key; None if there is none that is whole."""
        self.used.add(f"{key}.json")
        try:
            kept = read_sealed(self.folder / f"{key}.json", KIND)
            return str(kept["svg"]), str(kept["csv"])
        except (OSError, InputError, KeyError):
            return None

    def write(self, key: str, svg: str, csv: str) -> None:
        """Keep a figure."""
        write_sealed(self.folder / f"{key}.json", {"svg": svg, "csv": csv}, KIND)

    def drop_unused(self) -> None:
        """Remove the figures that were not asked for."""
        for file in self.folder.glob("*.json"):
            if file.name not in self.used:
                file.unlink(missing_ok=True)


_KEPT: ContextVar[KeptFigures | None] = ContextVar("kept figures", default=None)


@contextmanager
def kept_figures(folder: str | Path) -> Iterator[None]:
    """Take figures from a folder, and keep in it those that are drawn, while the block runs."""
    kept = KeptFigures(Path(folder))
    token = _KEPT.set(kept)
    try:
        yield
    finally:
        _KEPT.reset(token)
    kept.drop_unused()


def plot(
    alt: str, synthetic: bool, draw: Callable[P, Figure], *args: P.args, **kwargs: P.kwargs
) -> Plot:
    """Draw a figure, or take it from those that are kept, and write it for the page.

    Parameters
    ----------
    alt : str
        The figure in words, for those who cannot see it; its file is named after it.
    synthetic : bool
        Whether it shows synthetic data.
    draw : callable
        A plotting function of `nptcs.report.figures`.
    *args, **kwargs
        Its arguments.
    """
    kept = _KEPT.get()
    key = None if kept is None else figure_key(draw, *args, **kwargs)
    found = None if kept is None or key is None else kept.read(key)
    if found is None:
        figure = draw(*args, **kwargs)
        data = data_of(figure)
        found = compact(to_svg(figure)), "" if data is None else csv_of(data)
        if kept is not None and key is not None:
            kept.write(key, *found)
    svg, csv = found
    words = f"{alt} (synthetic data)" if synthetic else alt
    return Plot(labelled(svg, words), alt, file_name(alt), packed(csv), synthetic)


def figure_key(draw: Callable[P, Figure], *args: P.args, **kwargs: P.kwargs) -> str | None:
    """Name a figure by everything that it is drawn from; None where that cannot be told."""
    try:
        content = pickle.dumps((args, sorted(kwargs.items())), protocol=5)
    except (pickle.PicklingError, TypeError, AttributeError):
        return None
    code = _code_of(draw.__module__)
    words = f"{current_language()} {catalogue_digest(current_language())}"
    name = f"{draw.__module__}.{draw.__qualname__} {code} {mpl.__version__} {words} ".encode()
    return hashlib.sha256(name + content).hexdigest()


@cache
def _code_of(module: str) -> str:
    """Hash the code that draws a figure, with its words."""
    return code_hash(module, __name__, words=True)


def csv_of(data: pd.DataFrame) -> str:
    """Write the numbers of a figure as CSV text, to `DIGITS` significant digits."""
    return data.to_csv(index=False, float_format=f"%.{DIGITS}g", lineterminator="\n")


def packed(csv: str) -> str:
    """Deflate CSV text and write it in base64, for an attribute of the page; empty for none."""
    if not csv:
        return ""
    packer = zlib.compressobj(9, zlib.DEFLATED, -zlib.MAX_WBITS)
    return base64.b64encode(packer.compress(csv.encode()) + packer.flush()).decode()


def file_name(alt: str) -> str:
    """Name the file of a figure after its words.

    Examples
    --------
    >>> file_name("Stress over strain, series T0 (15 %)")
    'stress-over-strain-series-t0-15'
    """
    return "-".join(re.findall(r"\w+", alt.lower()))[:80]


def labelled(svg: str, words: str) -> str:
    """Give a figure the words that a screen reader says."""
    return svg.replace("<svg ", f'<svg role="img" aria-label="{escape(words)}" ', 1)
