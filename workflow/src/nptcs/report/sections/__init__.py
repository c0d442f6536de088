"""Sections of the report, in reading order, one module each.

`Results` and the sheets come in, a `view.Section` goes out. Numbers are taken from tables: what is
not in a table is not computed here.
"""
