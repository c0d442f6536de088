"""Sections of the report, one module each; `plan` names them in reading order.

`Results` and the sheets come in, a `nptcs.report.blocks.Section` goes out. Numbers are taken from
tables; nothing that is missing there is computed here.
"""
