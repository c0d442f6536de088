"""The tyre: the ring of shear band and tread on its spokes, pressed against the ground.

An energy table, a rubber and a mesh come in, a loaded tyre (`equilibrium`) goes out. Nothing here
depends on where the energy of a spoke comes from.
"""
