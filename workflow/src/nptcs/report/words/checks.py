"""Checks of a material card as the page writes them."""

from __future__ import annotations

from nptcs.language import translatable
from nptcs.report.tables.names import in_words
from nptcs.report.words.flags import flag_text, translated

SENTENCES = (
    translatable("compliance matrix is positive definite"),
    translatable("stable in Drucker's sense in all modes up to strain {strain}"),
    translatable(
        "toe or curvature: with a free strain offset of {offset} % the neo-Hookean C10 is "
        "{c10} MPa; without it {change} %"
    ),
    translatable("toe: not assessed, a free strain offset leaves no stiffness"),
    translatable("toe: not assessed, too few points above it"),
    translatable("toe: not assessed, the curves carry no tension above it"),
    translatable(
        "strain origin: corrected in {shifted} of {total} specimens, by up to {largest} % ± "
        "{error} %; without it {name} would be {raw}, not {value}"
    ),
    translatable(
        "{name}: the strain origin was corrected in {shifted} of {total} specimens, which "
        "changed the values by {low} to {high} %"
    ),
)
"""Checks as the calibration writes them."""

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
    text = check.removeprefix(WARNING)
    return in_words(translated(text, SENTENCES) or flag_text(text), {})
