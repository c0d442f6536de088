"""Readings of one specimen made into one curve: paired, cleaned, signed, checked.

Quantities of one or two raw files come in; `signals.Signals` on common rows go out, with a note for
each step. Properties are not computed here: they belong to `nptcs.reduce`.
"""
