"""Whether numba is installed, and how formulas are marked for it."""

from __future__ import annotations

from collections.abc import Callable
from importlib.util import find_spec
from typing import Any, Literal, TypeVar

Kernel = Literal["numpy", "numba"]
"""What computes an iterate; both give the same numbers up to rounding."""

Function = TypeVar("Function", bound=Callable[..., object])

OPTIONS: dict[str, Any] = {"cache": True, "nogil": True, "error_model": "numpy"}
"""Of all compiled functions."""

HAS_NUMBA = find_spec("numba") is not None


def compilable(function: Function) -> Function:
    """Mark a function that compiled code may call; plain Python calls it unchanged."""
    return _marked(function, forceinline=False)


def compiled_inline(function: Function) -> Function:
    """Mark a function as `compilable` does, and have it inlined wherever it is called."""
    return _marked(function, forceinline=True)


def _marked(function: Function, forceinline: bool) -> Function:
    if not HAS_NUMBA:
        return function
    from numba.extending import register_jitable

    marked: Function = register_jitable(forceinline=forceinline)(function)
    return marked
