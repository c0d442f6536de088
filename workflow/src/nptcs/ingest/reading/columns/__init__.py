"""Which column is which quantity, in which unit; what the head of a file says of it.

Names, units and the lines above a table come in; quantities and labels go out. Nothing is converted
before the unit is known.
"""
