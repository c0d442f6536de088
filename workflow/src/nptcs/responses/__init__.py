"""What a designer asks of a solved tyre: stiffness at any load, contact, margins of the plates.

Case records come in, tables go out. No tyre is solved here, so other loads, strengths or densities
need no new solution.
"""
