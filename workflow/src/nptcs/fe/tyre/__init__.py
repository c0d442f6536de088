"""The tyre: the ring of shear band and tread on spokes' energies, pressed on the ground.

An energy table, a rubber and a mesh come in, a loaded tyre (`equilibrium`) goes out. Where the
energy of a spoke comes from is not known here.
"""
