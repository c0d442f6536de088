"""The room that Chinese text takes in a figure, without a Chinese font on this machine.

Text of a figure stays text, so that the browser draws it with a font of its own. Matplotlib
measures it with a font that has no Chinese characters; all of them are as wide as the font is high,
as an em dash is.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

from matplotlib.backends.backend_svg import RendererSVG
from matplotlib.font_manager import FontProperties

from nptcs.report.text import is_wide

EM_DASH = "\N{EM DASH}"


@contextmanager
def wide_characters_measured() -> Iterator[None]:
    """Measure each Chinese character as an em dash while the block draws."""
    measure = RendererSVG.get_text_width_height_descent

    def measured(
        self: RendererSVG, s: str, prop: FontProperties, ismath: bool
    ) -> tuple[float, float, float]:
        text = "".join(EM_DASH if is_wide(character) else character for character in s)
        width, height, descent = measure(self, text, prop, ismath)
        if text != s:
            # an em dash is low; a Chinese character is as high as a capital with its accent
            _, height, descent = measure(self, "Åg", prop, ismath)
        return width, height, descent

    RendererSVG.get_text_width_height_descent = measured  # type: ignore[method-assign]
    try:
        yield
    finally:
        RendererSVG.get_text_width_height_descent = measure  # type: ignore[method-assign]
