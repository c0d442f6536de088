"""Names and numbers that are not broken across lines of the page."""

from __future__ import annotations

import re

from markupsafe import Markup, escape

NAME = re.compile(r"(?<![\w-])(?:[A-Z]\w{0,5}-\w{1,3})(?![\w-])")
"""A name with a hyphen, such as that of a specimen (R88-2) or of a factor (T-C)."""

UNIT = re.compile(r"(?<=\d) (?=(?:%|°C|N/mm|MPa|GPa|mm|kN|N|kg)(?!\w))")
"""A blank between a number and its unit."""


def kept(text: object) -> Markup:
    r"""Write a text as HTML that is not broken within a short name or before a unit.

    Examples
    --------
    >>> print(kept("C10 (T-C) < 5"))
    C10 (<span class="nb">T-C</span>) &lt; 5
    >>> kept("grows by 3 % to 5 MPa")
    Markup('grows by 3\xa0% to 5\xa0MPa')
    """
    written = UNIT.sub("\u00a0", str(escape(text)))
    return Markup(NAME.sub(r'<span class="nb">\g<0></span>', written))
