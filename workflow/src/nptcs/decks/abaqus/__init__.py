"""The Abaqus deck of the whole tyre: `deck` puts it together from `parts`, which `mesh` fills.

Configuration, ply and factor values come in, keywords and data lines go out. Nothing is run here.
"""
