"""Names of factors, responses and properties in texts, as people write them."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from functools import partial

from nptcs.config.studies.study import Study
from nptcs.language import tr, translatable
from nptcs.report.factor_labels import factor_labels
from nptcs.report.tables.headings import heading
from nptcs.report.text import number_text
from nptcs.tables.result_table import Heading

NAME = re.compile(
    r"\b(?P<name>[a-z][a-z0-9]*(?:_[a-z0-9]+)+|nu\d\d)\b"
    r"(?: (?P<error>± )?(?P<number>[-+]?[\d.]+(?:e[-+]?\d+)?))?"
)
"""A name of a column or a response, and the number that follows it."""

PHRASES = {
    re.compile(r"\b(?P<plates>\d+) plates\b"): translatable("{plates} plates"),
    re.compile(r" at (?P<at>\d[\d.]* \w+)"): translatable(" at {at}"),
    re.compile(r"\bminimise\b"): translatable("minimise"),
    re.compile(r"\bmaximise\b"): translatable("maximise"),
    re.compile("the surface's own error"): translatable("the surface's own error"),
}
"""Words around the names in designs and goals."""


def in_words(text: str, labels: Mapping[str, Heading]) -> str:
    r"""Write names such as ``spacing_mm 14.333, e1_mpa ± 76`` as people do, with units.

    Examples
    --------
    >>> in_words("22 plates, spacing_mm 14.333", {"spacing_mm": Heading("spacing S", "mm")})
    '22 plates, spacing S\xa014.33\xa0mm'
    >>> in_words("e1_mpa ± 76.2, nu12", {})
    'E1\xa0± 76.2\xa0MPa, ν12'
    """
    for phrase, words in PHRASES.items():
        text = phrase.sub(partial(_phrase, words), text)
    return NAME.sub(lambda found: _in_words(found, labels), text)


def _phrase(words: str, found: re.Match[str]) -> str:
    return tr(words, **found.groupdict())


def _in_words(found: re.Match[str], labels: Mapping[str, Heading]) -> str:
    label = heading(found["name"], labels)
    if found["number"] is None:
        return label.name
    gap = "" if label.unit in ("", "°") else "\u00a0"
    number = found["number"] if found["error"] else number_text(float(found["number"]), 4)
    return f"{label.name}\u00a0{found['error'] or ''}{number}{gap}{label.unit}"


def factor_headings(studies: Iterable[Study]) -> dict[str, Heading]:
    """Return how the factors of studies are written; the first study's label counts."""
    found: dict[str, Heading] = {}
    for study in studies:
        for name, label in factor_labels(study).items():
            found.setdefault(name, Heading(label.label, label.unit))
    return found
