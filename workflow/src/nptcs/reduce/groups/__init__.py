"""Groups of specimens: which values count, their statistics, pooling, and flags collected.

Rows of properties come in; one row for each group and property goes out. No curve is used here.
"""
