"""The Abaqus deck of the whole tyre: `deck` assembles it from `parts`, whose meshes `mesh` makes.

Configuration, ply and factor values come in, keywords and data lines go out. Nothing is run here.
"""
