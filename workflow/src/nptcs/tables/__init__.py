"""One contract for each table that crosses a file boundary, and nothing that computes.

A table comes in from a file or a stage, the same table goes out, checked (`io.read_table`,
`io.write_table`); `catalogue` lists all tables of a run. What makes or compares them belongs to
the stages.
"""
