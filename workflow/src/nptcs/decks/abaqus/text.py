"""Lines of an Abaqus deck: comments, numbers, data lines."""

from __future__ import annotations

import textwrap
from collections.abc import Iterable

RULE = "** " + "=" * 76
THIN_RULE = "** " + "-" * 76


def comment(text: str) -> list[str]:
    """Break a comment into lines."""
    return [f"** {line}" for line in textwrap.wrap(text, 76)]


def number(value: float) -> str:
    """Write a decimal number with its point, without a negative zero."""
    text = f"{round(float(value), 10) + 0.0:.10g}"
    return text if any(mark in text for mark in ".e") else f"{text}."


def numbers(values: Iterable[float]) -> str:
    """Write a data line of decimal numbers."""
    return ", ".join(number(value) for value in values)


def members(labels: Iterable[int]) -> list[str]:
    """Write the data lines of a set, at most 16 labels each."""
    text = [str(label) for label in labels]
    return [", ".join(text[i : i + 16]) + "," for i in range(0, len(text), 16)]
