"""Contracts of a laboratory's data: sheet, files, curves, properties, statistics, material cards.

What states or follows from a test of a specimen is here. What a solved tyre gives is in
`nptcs.tables.tyres`; nothing is computed.
"""
