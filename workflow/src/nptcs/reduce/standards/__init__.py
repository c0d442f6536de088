"""One module for each kind of test, by its standards: from a curve to its properties.

A curve, its specimen and the rules of the configuration come in; rows of properties go out. Groups
of specimens belong to `nptcs.reduce.groups`.
"""
