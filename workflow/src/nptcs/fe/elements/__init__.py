"""Elements and materials: shape functions, energies, forces and tangents of many elements at once.

Nodes and displacements come in, element forces and tangents go out. Which elements make a spoke or
a tyre is not known here.
"""
