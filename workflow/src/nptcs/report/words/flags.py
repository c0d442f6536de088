"""Flags and checks, which the tables have in English, in the language of the page.

A table is the same in every language: its flags are English sentences with numbers in them. The
page finds the sentence that a flag was made from, and writes its translation with the same
numbers. A flag of another wording stays as the table has it.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from functools import cache

from nptcs.language import ENGLISH, Language, current_language, tr, translatable
from nptcs.report.words.analysis_sentences import SENTENCES as ANALYSIS
from nptcs.report.words.conditioning_sentences import SENTENCES as CONDITIONING
from nptcs.report.words.reduction_sentences import SENTENCES as REDUCTION

SENTENCES = (
    translatable("crosshead strain: it includes the compliance of machine and grips"),
    translatable(
        "crosshead strain: modulus and strains include the compliance of machine and grips"
    ),
    translatable("source of the strain not stated"),
    translatable("the file does not say what measured the strain"),
    translatable("{name} not given, area: {rule}"),
    translatable("{name} {mean} mm, {standard} recommends {low} to {high} mm"),
    translatable("{name} measured at {count} of {stations} stations"),
    translatable("failure after {minutes} min, {standard} requires {low} to {high} min"),
    translatable(
        "the gauge length grows at {speed} mm/min, {standard} (500 mm/min between the grips) "
        "expects {low} to {high}"
    ),
    translatable("{count} of {loadings} loadings, {standard} measures the last"),
    translatable("chord {words} {value}, {standard} requires {low} to {high}"),
    translatable(
        "strain at the largest force extended from the last {frames} frames before it, by {time}"
    ),
    translatable("{frames} of {total} frames have no strain"),
    translatable("preload and toe not corrected: {reason}"),
    translatable("slack or long toe: strain {strain} before loading was cut"),
    translatable("the solver does not report it"),
    translatable("the solver does not report the plates' volume"),
    translatable("no spoke was solved again at its motion in the tyre"),
    translatable("no plate_price_per_kg in the configuration"),
    translatable("the curve ends at {load} N and {displacement} mm"),
    translatable("orthotropic, not transversely isotropic: {detail}"),
    translatable("transversely isotropic within {tolerance} %: {detail}"),
    # notes on groups, constants and uncertainties
    translatable("B-basis provisional: n = {n} < {full}"),
    translatable("no B-basis: n = {n}, at least {smallest}"),
    translatable("not normally distributed (Shapiro-Wilk p = {p}): B-basis doubtful"),
    translatable("n = {n}, {standard} requires {asked}"),
    translatable("ranges differ between specimens"),
    translatable("preload and toe corrected in the others, not in {names}"),
    translatable("assessed: {count} of {total}"),
    translatable("flagged: {names}"),
    translatable("scatter between {n} specimens (jackknife)"),
    translatable("constants not determined: {names}"),
    translatable("{name} at the bound {bound} of the search"),
    translatable("standard error larger than the value: {names}"),
    translatable("the curve ends at {load} N"),
    translatable("stated, not tested: {percent} %"),
    translatable("{rule}: no test states how uncertain it is"),
    translatable("uncertainty.tolerances of the configuration"),
    translatable("prediction interval of the surface, at least its error at left-out cases"),
    translatable("effect of the ply not assessed: the lamination form describes only stiffness"),
    translatable(
        "effect of the ply not assessed: the lamination form has only the factors S, T and A"
    ),
    translatable("effect of the rubbers not assessed: no study of this solver varies them"),
    translatable("effect of the rubbers not assessed: their study varies other factors too"),
    translatable("ordinary least squares in coded units, solved cases only"),
    translatable("assumed equal to {other}"),
    translatable("assumed value"),
    translatable("not assessed: {reason}"),
    *REDUCTION,
    *ANALYSIS,
    *CONDITIONING,
)
"""The sentences, as the stages write them; ``{…}`` stands for what differs."""

JOINTS = (" | ", "; ")
"""Separators of several sentences: between rules of several tests, between sentences of one."""

SPAN = re.compile(r"^(?P<low>[-+.\de]+) to (?P<high>[-+.\de]+)(?P<unit>.*)$", re.DOTALL)
"""The lowest and the highest number of flags that are collected into one."""


def flag_text(flag: str) -> str:
    """Write a sentence of a stage, or several that are joined, in the language of the run.

    A text that matches no sentence is looked up whole, so a user's own words stay as they are.

    Examples
    --------
    >>> flag_text("not assessed: no transverse strain")
    'not assessed: no transverse strain'
    """
    language = current_language()
    return flag if language == ENGLISH else _flag_text(flag, language)


@cache
def _flag_text(flag: str, language: Language) -> str:
    """Write a flag in the current language, an argument so that each has its cache entry."""
    if (written := translated(flag, SENTENCES)) is not None:
        return written
    for mark in JOINTS:
        first, found, rest = flag.partition(mark)
        if found:
            return f"{_flag_text(first, language)}{mark}{_flag_text(rest, language)}"
    place, colon, sentence = flag.partition(": ")
    known = tr(flag)
    return f"{place}: {_flag_text(sentence, language)}" if colon and known == flag else known


def translated(text: str, sentences: Sequence[str]) -> str | None:
    """Write a text that was made from one of some sentences; None if it was not."""
    if text in sentences:
        return tr(text)
    for sentence in sentences:
        if found := pattern(sentence).fullmatch(text):
            values = {name: _value(value) for name, value in found.groupdict().items()}
            return tr(sentence, **values)
    return None


@cache
def pattern(sentence: str) -> re.Pattern[str]:
    """Return the pattern that all flags made from a sentence match.

    Examples
    --------
    >>> pattern("{frames} of {total} frames").fullmatch("3 of 12 frames").groupdict()
    {'frames': '3', 'total': '12'}
    """
    parts = re.split(r"\{(\w+)\}", sentence)
    text = "".join(
        f"(?P<{part}>[^;|]+?)" if place % 2 else re.escape(part) for place, part in enumerate(parts)
    )
    return re.compile(text)


def _value(text: str) -> str:
    """Write a value in a sentence: itself a sentence, a span of numbers, a list, or as it is."""
    if " " in text and (written := translated(text, SENTENCES)) is not None:
        return written
    if span := SPAN.fullmatch(text):
        return tr("{low} to {high}", low=span["low"], high=span["high"]) + span["unit"]
    first, comma, rest = text.partition(", ")
    return f"{_value(first)}, {_value(rest)}" if comma else tr(text)
