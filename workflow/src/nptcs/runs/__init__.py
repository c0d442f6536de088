"""Finished runs: their identity, and the comparison of two of them.

The tables, inputs, configuration and code of a run come in; its identity (a hash of their content)
goes out, or the differences between two runs, table by table. Comparing computed with published
values belongs to `compare`; pages and sheets are made in `report`.
"""
