"""Figures as data URIs, so that the page needs no other file; figures drawn before are kept.

Drawing takes most of the time of a report. A figure is kept under a name made of everything that
it is drawn from: the plotting function with its code, its arguments and the version of matplotlib.
"""

from __future__ import annotations

import hashlib
import pickle
import re
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from pathlib import Path
from typing import ParamSpec

import matplotlib as mpl
from matplotlib.figure import Figure

from nptcs.errors import InputError
from nptcs.files import read_sealed, write_sealed
from nptcs.language import catalogue_digest, current_language
from nptcs.provenance import code_hash
from nptcs.report.blocks import Plot
from nptcs.report.figures.style import PANEL, to_svg

KIND = "Figure"
PIXELS_PER_POINT = 96 / 72
SIZE = re.compile(r'<svg [^>]*?width="([\d.]+)pt" height="([\d.]+)pt"')

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

    def read(self, key: str) -> str | None:
        """Return the SVG text kept under a key; None if there is none that is whole."""
        self.used.add(f"{key}.json")
        try:
            return str(read_sealed(self.folder / f"{key}.json", KIND)["svg"])
        except (OSError, InputError, KeyError):
            return None

    def write(self, key: str, svg: str) -> None:
        """Keep a figure."""
        write_sealed(self.folder / f"{key}.json", {"svg": svg}, KIND)

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
    """Draw a figure, or take it from those that are kept, and turn it into a data URI.

    Parameters
    ----------
    alt : str
        The figure in words, for those who cannot see it.
    synthetic : bool
        Whether it shows synthetic data.
    draw : callable
        A plotting function of `nptcs.report.figures`.
    *args, **kwargs
        Its arguments.
    """
    kept = _KEPT.get()
    key = None if kept is None else figure_key(draw, *args, **kwargs)
    svg = None if kept is None or key is None else kept.read(key)
    if svg is None:
        svg = to_svg(draw(*args, **kwargs))
        if kept is not None and key is not None:
            kept.write(key, svg)
    size = SIZE.search(svg)
    points = size.groups() if size else (72 * side for side in PANEL)
    width, height = (round(float(side) * PIXELS_PER_POINT) for side in points)
    return Plot(data_uri(svg), alt, width, height, synthetic)


def figure_key(draw: Callable[P, Figure], *args: P.args, **kwargs: P.kwargs) -> str | None:
    """Name a figure by everything that it is drawn from; None where that cannot be told."""
    try:
        content = pickle.dumps((args, sorted(kwargs.items())), protocol=5)
    except (pickle.PicklingError, TypeError, AttributeError):
        return None
    code = code_hash(draw.__module__, "nptcs.report.figures.style", words=True)
    words = f"{current_language()} {catalogue_digest(current_language())}"
    name = f"{draw.__module__}.{draw.__qualname__} {code} {mpl.__version__} {words} ".encode()
    return hashlib.sha256(name + content).hexdigest()


def data_uri(svg: str) -> str:
    """Write SVG text as a data URI for an attribute between single quotes.

    Percent encoding of the few characters that need it takes a quarter less room than base64.
    """
    for character in "%#'":
        svg = svg.replace(character, f"%{ord(character):02X}")
    return "data:image/svg+xml," + " ".join(svg.split())
