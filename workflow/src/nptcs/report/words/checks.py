"""Checks of a material card as the page writes them."""

from __future__ import annotations

from nptcs.report.tables.names import in_words
from nptcs.report.words.flags import flag_text

WARNING = "warning: "
"""Prefix of those checks that every reader must see."""


def check_text(check: str) -> str:
    """Write a check without its prefix, with the symbols of the constants.

    Examples
    --------
    >>> check_text("warning: without it c10_mpa would be 1.195, not 1.171")
    'without it C10 would be 1.195, not 1.171'
    >>> check_text("reciprocity nu12/E1 = nu21/E2 sets nu21 = 0.02509")
    'reciprocity ν12/E1 = ν21/E2 sets ν21 = 0.02509'
    """
    return in_words(flag_text(check.removeprefix(WARNING)), {})
