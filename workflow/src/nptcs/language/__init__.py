"""The language of what a reader sees: English text comes in, text in the run's language goes out.

A text is written in English where it is used, as ``tr("{used} of {total} specimens used", used=3,
total=4)``; the English text is its key in the catalogue of each other language
(``catalogues/zh.po``, gettext's format). Numbers, units, file names, column names and the words of
tables that programs read do not belong here: they are the same in every language.
"""

from nptcs.language.translate import (
    ENGLISH,
    Language,
    catalogue_digest,
    current_language,
    language,
    tr,
    tr_count,
    translatable,
)

__all__ = [
    "ENGLISH",
    "Language",
    "catalogue_digest",
    "current_language",
    "language",
    "tr",
    "tr_count",
    "translatable",
]
