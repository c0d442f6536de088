"""What a spoke does in the load-bearing model: two stiffnesses, or force against displacement.

Laws and their tables against the rubber's C10 come from here. How a ring on such spokes is solved
does not belong here.
"""
