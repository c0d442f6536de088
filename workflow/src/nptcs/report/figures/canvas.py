"""Canvas for SVG with real text in any script: wide characters are measured as wide.

The SVG names fonts and leaves the glyphs to the reader's system. The font that measures the layout
has no Chinese characters; the square in their place is narrower than they are, and texts would
run into each other.
"""

from __future__ import annotations

import io
from functools import lru_cache
from typing import Any, TextIO

from matplotlib.backends.backend_svg import FigureCanvasSVG, RendererSVG
from matplotlib.font_manager import FontProperties
from matplotlib.textpath import text_to_path

from nptcs.report.text import is_wide

AS_WIDE = "\N{EM DASH}"
"""As wide as a Chinese character, in the font of the layout."""

AS_HIGH = "Åg"
"""A dash is low; a Chinese character is as high as a capital letter with an accent."""

POINTS_PER_INCH = 72.0


@lru_cache(maxsize=5000)
def measured(text: str, font: FontProperties, formula: Any) -> tuple[float, float, float]:
    """Return width, height and descent of a text, in points: figures share most of their words."""
    wide = "".join(AS_WIDE if is_wide(letter) else letter for letter in text)
    width, height, descent = text_to_path.get_text_width_height_descent(wide, font, formula)
    if wide != text:
        _, height, descent = text_to_path.get_text_width_height_descent(AS_HIGH, font, formula)
    return width, height, descent


class WideRenderer(RendererSVG):
    """Measures wide characters as one em; draws them as they are."""

    def get_text_width_height_descent(
        self, s: str, prop: FontProperties, ismath: Any
    ) -> tuple[float, float, float]:
        """Return width, height and descent of a text, in points."""
        return measured(s, prop.copy(), ismath)


class WideCanvas(FigureCanvasSVG):
    """Lays a figure out and writes it with `WideRenderer`."""

    def get_renderer(self) -> WideRenderer:
        """Return the renderer that measures the layout; what it draws is discarded."""
        return self._renderer(io.StringIO())

    def write(self, stream: TextIO) -> None:
        """Write the figure as SVG without metadata."""
        self.figure.dpi = POINTS_PER_INCH
        renderer = self._renderer(stream)
        self.figure.draw(renderer)
        renderer.finalize()

    def _renderer(self, stream: TextIO) -> WideRenderer:
        self.figure.dpi = POINTS_PER_INCH
        width, height = (POINTS_PER_INCH * side for side in self.figure.get_size_inches())
        nothing = dict.fromkeys(("Date", "Creator", "Format", "Type"))
        return WideRenderer(width, height, stream, image_dpi=POINTS_PER_INCH, metadata=nothing)
