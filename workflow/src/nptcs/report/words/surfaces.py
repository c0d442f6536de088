"""Names of surfaces in the language of the page; tables and commands use the English names."""

from __future__ import annotations

import re

from nptcs.language import ENGLISH, current_language, tr, translatable

WHOLE = (
    translatable("spoke process"),
    translatable("the mean"),
)
"""Names without a part that differs."""

POLYNOMIAL = re.compile(
    r"polynomial(?: of (?P<link>log|reciprocal))?(?P<origin> through the origin)?"
    r"(?: with (?P<count>\d+) own terms)?(?:, terms by (?P<choice>aicc|press))?"
)
LAMINATION = re.compile(r"lamination (?P<count>\d+)")
ON = "gaussian process on "

LINKS = {
    "log": translatable("polynomial of the logarithm"),
    "reciprocal": translatable("polynomial of the reciprocal"),
}


def surface_words(name: str) -> str:
    """Write the name of a surface for a reader.

    The name is that of `nptcs.config.studies.surface.surface_name`. English names stay as they
    are, because the configuration and ``nptcs design`` expect them; a name of another form stays
    as it is in every language.

    Examples
    --------
    >>> surface_words("gaussian process on lamination 6")
    'gaussian process on lamination 6'
    """
    if current_language() == ENGLISH:
        return name
    if name in WHOLE:
        return tr(name)
    if name.startswith(ON):
        mean = surface_words(name.removeprefix(ON))
        return tr("gaussian process on {mean}", mean=mean)
    if found := LAMINATION.fullmatch(name):
        return tr("lamination {count}", count=found["count"])
    found = POLYNOMIAL.fullmatch(name)
    return name if found is None else _polynomial(found)


def _polynomial(found: re.Match[str]) -> str:
    """Write a polynomial with what it is fitted to, its origin, its terms and their choice."""
    text = tr(LINKS[found["link"]]) if found["link"] else tr("polynomial")
    if found["origin"]:
        text = tr("{surface} through the origin", surface=text)
    if found["count"]:
        text = tr("{surface} with {count} own terms", surface=text, count=found["count"])
    if found["choice"]:
        criterion = {"aicc": "AICc", "press": "PRESS"}[found["choice"]]
        text = tr("{surface}, terms by {criterion}", surface=text, criterion=criterion)
    return text
