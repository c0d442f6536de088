"""Elements and materials: shape functions, energies, forces and tangents of many elements at once.

Nodes and displacements come in, element forces and tangents go out. Nothing here depends on which
elements make up a spoke or a tyre.
"""
