"""Contracts of what is concluded from cases: surfaces, sensitivities, uncertainty, decisions.

Coefficients, predictions and rankings are here. The cases that they rest on are in
`nptcs.tables.tyres`.
"""
