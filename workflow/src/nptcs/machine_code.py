"""Functions that numba compiles, kept on disk for the processes that follow.

A module that imports this one is imported where it is first needed, not with the package: numba
takes half a second to import. Compiled functions that call each other stay in one file: numba
renews its copies on disk by the date of the file in which a function is defined.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeVar

from numba import njit

Function = TypeVar("Function", bound=Callable[..., Any])

OPTIONS: dict[str, Any] = {"error_model": "numpy", "fastmath": {"contract"}}


def compiled(function: Function) -> Function:
    """Compile a function for the types that it is called with.

    The machine code is kept next to the source, or in the user's folder of numba; if neither can
    be written to, each process compiles for itself.
    """
    try:
        kept: Function = njit(cache=True, **OPTIONS)(function)
    except RuntimeError:
        kept = njit(**OPTIONS)(function)
    return kept
