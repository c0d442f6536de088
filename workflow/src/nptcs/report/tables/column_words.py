"""Texts in the columns of tables, in the language of the run."""

from __future__ import annotations

from nptcs.language import tr
from nptcs.report.tables.names import phrases
from nptcs.report.words.flags import flag_text
from nptcs.report.words.messages import message_text
from nptcs.report.words.surfaces import surface_words

WORDS = frozenset(
    {"status", "origin", "include", "synthetic", "result", "confirmation", "group", "kind", "test"}
    | {"scope", "reported_statistic", "region", "goal_met", "drucker_stable", "outside_the_box"}
    | {"failed", "values_used", "model", "beyond_uncertainty", "data", "path", "area_rule"}
)
"""Columns that hold words of closed sets."""

FLAGS = frozenset(
    {"flag", "flags", "not_assessed", "notes", "standard_error_rule", "range", "left_out", "noise"}
    | {"p_meaning", "estimable"}
)
"""Columns that hold flags and short sentences."""

MESSAGES = frozenset(
    {"message", "note", "not_fitted", "reason", "remarks", "rule", "source", "form"}
)
"""Columns that hold messages of stages, and sentences around names."""

SURFACE = "surface"
"""Column that holds names of surfaces."""

PHRASED = frozenset({"design", "goal", "goals", "quantities"})
"""Columns that hold names and numbers with a few words around them."""


def column_words(column: str, value: object) -> object:
    """Write a text of a column in the language of the run; names and numbers stay as they are.

    Parameters
    ----------
    column : str
        As in the file.
    value : object
        Of one row.

    Returns
    -------
    object
        The same value where it is not a text, or where its column holds names alone.
    """
    if not isinstance(value, str):
        return value
    if column in FLAGS:
        return flag_text(value)
    if column in MESSAGES:
        return message_text(value)
    if column == SURFACE:
        return surface_words(value)
    if column in PHRASED:
        return phrases(value)
    return tr(value) if column in WORDS else value
