"""Names of factors, responses and properties in texts, as people write them."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from functools import cache, partial

from nptcs.config.studies.study import Study
from nptcs.language import tr, translatable
from nptcs.report.factor_labels import factor_labels
from nptcs.report.tables.headings import heading
from nptcs.report.text import number_text
from nptcs.tables.catalogue import TABLES
from nptcs.tables.result_table import Heading

NAME = re.compile(
    r"\b(?P<name>[a-z][a-z0-9]*(?:_[a-z0-9]+)+|nu\d\d)\b"
    r"(?: (?P<error>± )?(?P<number>[-+]?[\d.]+(?:e[-+]?\d+)?))?"
)
"""A name of a column or a response, and the number that follows it."""

SYMBOL = re.compile(r"[A-Z](?:-?[A-Z])?")
"""A symbol of a factor, such as S or T-C."""

SUPERSCRIPTS = "⁰¹²³⁴⁵⁶⁷⁸⁹"

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
    >>> in_words("e1_mpa ± 2.04e+03", {})
    'E1\xa0± 2040\xa0MPa'
    """
    return NAME.sub(lambda found: _in_words(found, labels), phrases(text))


def in_headings(text: str, labels: Mapping[str, Heading]) -> str:
    """Write names of columns with commas between them as the headings of tables, without units.

    Examples
    --------
    >>> in_headings("with_probability, spacing_mm", {"spacing_mm": Heading("spacing S", "mm")})
    'required probability, spacing S'
    """
    known = {**_headings_of_results(), **labels}
    return ", ".join(heading(name, known).name for name in text.split(", "))


@cache
def _headings_of_results() -> dict[str, Heading]:
    """Return the headings that the catalogue gives to columns; the first table's counts."""
    tables = reversed(TABLES.values())
    return {name: one for table in tables for name, one in table.headings.items()}


def known_in_words(text: str, labels: Mapping[str, Heading]) -> str:
    """Write the names that have a label as people do; any other word may be part of a file's name.

    Examples
    --------
    >>> known_in_words("only in A: run_a/spacing_mm.csv; near tie with spacing_mm", {
    ...     "spacing_mm": Heading("spacing S", "mm"),
    ... })
    'only in A: run_a/spacing_mm.csv; near tie with spacing S'
    """
    if not labels:
        return text
    names = "|".join(map(re.escape, labels))
    pattern = re.compile(rf"(?<![\w./-])(?:{names})(?![\w/-]|\.\w)")
    return pattern.sub(lambda found: heading(found[0], labels).name, text)


def phrases(text: str) -> str:
    """Write the words around the names of a design or a goal in the language of the run.

    Examples
    --------
    >>> phrases("secant_stiffness at 5000 N")
    'secant_stiffness at 5000 N'
    """
    for phrase, words in PHRASES.items():
        text = phrase.sub(partial(_phrase, words), text)
    return text


def in_symbols(text: str, labels: Mapping[str, Heading]) -> str:
    """Write terms of a polynomial with the symbols that end the factors' labels.

    A factor whose label does not end in a symbol of its own is written by its label.

    Examples
    --------
    >>> in_symbols("spacing_mm*angle_deg^2", {
    ...     "spacing_mm": Heading("plate spacing S", "mm"),
    ...     "angle_deg": Heading("fibre angle A", "°"),
    ... })
    'S × A²'
    """
    symbols = {name: _symbol(label.name) for name, label in labels.items()}
    once = {one for one in symbols.values() if one and list(symbols.values()).count(one) == 1}
    written = {
        name: symbol if symbol in once else labels[name].name for name, symbol in symbols.items()
    }
    pattern = re.compile(r"\b(" + "|".join(map(re.escape, labels)) + r")\b" if labels else r"(?!)")
    text = pattern.sub(lambda found: written[found[1]], text.replace("*", " × "))
    return re.sub(r"\^(\d)", lambda found: SUPERSCRIPTS[int(found[1])], text)


def _symbol(label: str) -> str:
    """Return the symbol that a label ends in, in brackets or not; empty for none."""
    last = label.split()[-1].strip("()（）") if label.split() else ""
    return last if SYMBOL.fullmatch(last) else ""


def _phrase(words: str, found: re.Match[str]) -> str:
    return tr(words, **found.groupdict())


def _in_words(found: re.Match[str], labels: Mapping[str, Heading]) -> str:
    label = heading(found["name"], labels)
    if found["number"] is None:
        return label.name
    gap = "" if label.unit in ("", "°") else "\u00a0"
    number = number_text(float(found["number"]), 3 if found["error"] else 4)
    return f"{label.name}\u00a0{found['error'] or ''}{number}{gap}{label.unit}"


def factor_headings(studies: Iterable[Study]) -> dict[str, Heading]:
    """Return how the factors of studies are written; the first study's label counts."""
    found: dict[str, Heading] = {}
    for study in studies:
        for name, label in factor_labels(study).items():
            found.setdefault(name, Heading(label.label, label.unit))
    return found
