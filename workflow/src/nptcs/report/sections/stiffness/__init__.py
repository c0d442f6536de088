"""Computed next to published stiffness: levels, spokes, both rings, neutral lines, solvers.

The section itself is `published`. The other modules give it facts and figures, taken from tables.
"""
