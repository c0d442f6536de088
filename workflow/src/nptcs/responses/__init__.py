"""What a designer wants to know about a solved tyre: stiffness at any load, contact, plate margins.

Case records come in, tables go out. No tyre is solved here, so other loads, strengths or densities
need no new solution.
"""
