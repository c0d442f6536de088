"""Computed results compared with the published study.

Tables of this run and of the paper come in; tables with both values and their difference go out.
Nothing is solved or fitted here except the load-bearing model of the paper's own cases (`lca`). Two
runs are compared in `nptcs.runs`.
"""
