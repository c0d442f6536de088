"""Checks of single numbers, whose errors name the quantity."""

from __future__ import annotations

import math

from nptcs.errors import InputError


def require_positive(name: str, value: float) -> None:
    """Raise `InputError` unless `value` is a finite number above zero."""
    if not math.isfinite(value) or value <= 0:
        raise InputError(
            "must be a finite number above zero",
            remedy=f"give a positive {name}",
            column=name,
            value=value,
        )
