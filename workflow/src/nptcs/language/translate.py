"""Look up a text in the language of the run, and insert its values."""

from __future__ import annotations

import hashlib
import io
from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from functools import cache
from gettext import GNUTranslations, NullTranslations
from importlib import resources
from typing import Literal, get_args

Language = Literal["en", "zh"]
"""Languages of the report: English, and simplified Chinese."""

ENGLISH: Language = "en"

_CURRENT: ContextVar[Language] = ContextVar("language", default=ENGLISH)


@contextmanager
def language(code: Language) -> Iterator[None]:
    """Write all texts of the block in a language.

    Raises
    ------
    ValueError
        If the package has no such language.

    Examples
    --------
    >>> with language("zh"):
    ...     tr("yes")
    '是'
    >>> tr("yes")
    'yes'
    """
    if code not in get_args(Language):
        raise ValueError(f"no language {code!r}; known: {', '.join(get_args(Language))}")
    token = _CURRENT.set(code)
    try:
        yield
    finally:
        _CURRENT.reset(token)


def current_language() -> Language:
    """Return the language in which `tr` currently writes."""
    return _CURRENT.get()


def tr(text: str, /, **values: object) -> str:
    """Write a text in the language of the run.

    Parameters
    ----------
    text : str
        One whole sentence or term in English, with a named placeholder for each value. A text
        that is not in the catalogue, such as a user's own title, stays as it is.
    **values
        What the placeholders stand for, formatted as by `str.format`. Without any, braces in the
        text are ordinary characters.

    Returns
    -------
    str

    Examples
    --------
    >>> tr("{used} of {total} specimens used", used=3, total=4)
    '3 of 4 specimens used'
    """
    found = _translations(_CURRENT.get()).gettext(text) if text else ""
    return found.format(**values) if values else found


def tr_count(one: str, many: str, count: int, /, **values: object) -> str:
    """Write a text whose wording depends on a number; both wordings may use ``{count}``.

    Examples
    --------
    >>> tr_count("{count} problem", "{count} problems", 1)
    '1 problem'
    >>> tr_count("{count} problem", "{count} problems", 2)
    '2 problems'
    """
    found = _translations(_CURRENT.get()).ngettext(one, many, count)
    return found.format(count=count, **values)


def translatable(text: str) -> str:
    """Return a text unchanged: marks a constant that is passed to `tr` later for the catalogues."""
    return text


def catalogue_digest(code: Language) -> str:
    """Digest the catalogue of a language: a changed translation makes new pages and figures."""
    return "" if code == ENGLISH else hashlib.sha256(catalogue_file(code)).hexdigest()[:16]


def catalogue_file(code: Language) -> bytes:
    """Return the content of a language's catalogue."""
    return resources.files("nptcs.language").joinpath("catalogues", f"{code}.po").read_bytes()


@cache
def _translations(code: Language) -> NullTranslations:
    """Read the catalogue of a language."""
    if code == ENGLISH:
        return NullTranslations()
    # for other languages only: this library takes a tenth of a second to import
    from babel.messages.mofile import write_mo
    from babel.messages.pofile import read_po

    compiled = io.BytesIO()
    write_mo(compiled, read_po(io.BytesIO(catalogue_file(code)), locale=code, abort_invalid=True))
    compiled.seek(0)
    return GNUTranslations(compiled)
