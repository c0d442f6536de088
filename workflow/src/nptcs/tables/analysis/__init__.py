"""Contracts of what is concluded from cases: surfaces, sensitivities, uncertainty, decisions.

Coefficients, predictions and rankings are here. The cases that they are based on are in
`nptcs.tables.tyres`.
"""
