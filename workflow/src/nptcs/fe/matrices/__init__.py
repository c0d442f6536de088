"""Matrices of the two structures in the form that solves them fastest, and their factorisations.

Element tangents come in, solutions of linear systems go out. Nothing here depends on mechanics.
"""
