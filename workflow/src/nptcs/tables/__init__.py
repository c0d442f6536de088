"""One contract for each table and record that crosses a file boundary.

Columns, units and their meaning, and in `catalogue` one row per result table. Nothing is computed
here, and nothing of the campaign, the solvers or the report is imported.
"""
