"""Colours of the figures on light and on dark pages: one list for Matplotlib and for the page.

Matplotlib draws with the light colours. In the SVG each of them becomes a CSS variable, so a page
in dark mode shows the same figure in colours that have contrast on a dark background.
"""

from __future__ import annotations

from collections.abc import Mapping

COLOURS = ("#0072b2", "#d55e00", "#008f68", "#b8558c", "#a66f00", "#3a8fc4", "#4d4d4d")
"""For data: after Okabe and Ito, the light ones darkened to a contrast of 3:1 on white."""

DARK_COLOURS = ("#6ea8ff", "#ff9550", "#2fcf9c", "#ee9ccb", "#e8b53c", "#7fdcff", "#c4c4c4")

INK = "#000000"
GREY = "#666666"
GRID = "#dddddd"
RANGE = "#eeeeef"
"""Background of a range behind the data."""

PAPER = "#fffffe"
"""Background of the page; `white` stays white in dark mode, as on the colour map."""

WARNING = "#8a4b00"

LIGHT: Mapping[str, str] = {
    **{f"--f{number}": colour for number, colour in enumerate(COLOURS)},
    "--f-ink": INK,
    "--f-grey": GREY,
    "--f-grid": GRID,
    "--f-range": RANGE,
    "--f-paper": PAPER,
    "--f-warning": WARNING,
}
"""CSS variable → colour on a light page, as Matplotlib draws it."""

DARK: Mapping[str, str] = {
    **{f"--f{number}": colour for number, colour in enumerate(DARK_COLOURS)},
    "--f-ink": "#f0f2f4",
    "--f-grey": "#a9b0b6",
    "--f-grid": "#3a4046",
    "--f-range": "#2a3036",
    "--f-paper": "#15181b",
    "--f-warning": "#ffc27a",
}


def theme_css() -> str:
    """Write the variables for both modes: the reader's choice or the system's; print is light."""
    light, dark = (
        "".join(f"{name}:{colour};" for name, colour in colours.items())
        for colours in (LIGHT, DARK)
    )
    chosen = f":root[data-theme=dark]{{{dark}}}"
    system = f"@media (prefers-color-scheme: dark){{:root:not([data-theme=light]){{{dark}}}}}"
    return f":root{{{light}}}\n@media screen{{{chosen}{system}}}\n"
