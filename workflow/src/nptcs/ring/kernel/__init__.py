"""One iterate of the ring: energies of its parts, residual and tangent, by NumPy or by numba.

Positions of the nodes and the spokes' energies come in, the next correction goes out. Loads, paths
and steps belong to `nptcs.ring.solution`.
"""
