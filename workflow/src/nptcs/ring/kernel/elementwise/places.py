"""Numbers of unknowns, and places of a ring's constants."""

from __future__ import annotations

from typing import Any

# numbers where numba compiles, arrays where NumPy runs
Value = Any

UNKNOWNS = 5
# number of strains that stretch the rubber along the ring
ALONG = 4
VARIABLES = 10
# of the section and the ground
HALF, SURFACE, FOOT, OUTER, AREA_PER_LENGTH = 0, 1, 2, 3, 4
GROW_SECTION, GROW_FACE, GROW_SHEAR = 5, 6, 7
STIFF, SMOOTH, SLIP_STIFF, FRICTION, COMPLIANCE = 8, 9, 10, 11, 12
DIMENSIONS = 13
# of the core, after the three of the wires' pull
CORE_COMPLIANCE, WIRES_STIFF, CURVATURE = 3, 4, 5
