"""Spokes of the load-bearing model: two stiffnesses, or a curve of force against displacement.

A table of stiffness or of curves by the rubber's C10 comes in, the spokes of one rubber go out.
How a ring on such spokes is solved does not belong here.
"""
