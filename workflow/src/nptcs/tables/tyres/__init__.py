"""Contracts of what solvers give: cases, responses, curves, lines and stiffness of single spokes.

Every table here has one row per case, or several. What is fitted to cases is in
`nptcs.tables.analysis`.
"""
