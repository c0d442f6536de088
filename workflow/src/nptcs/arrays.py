"""The types of arrays: one place, so that every module writes the same name for the same thing."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
"""Real numbers; the docstring of each function says shape and unit."""

Floating = NDArray[np.floating]
"""Real numbers of any precision, as closed-form expressions return them."""

ComplexArray = NDArray[np.complexfloating]
"""Complex numbers."""

Index = NDArray[np.int64]
"""Whole numbers that count or number nodes, elements, unknowns or rows."""

Rows = NDArray[np.intp]
"""Positions that NumPy found, as `np.flatnonzero` returns them."""

Mask = NDArray[np.bool_]
"""True where something holds."""

Places = NDArray[np.int32]
"""Positions in arrays so large that reading 64 bits for each would take time."""
