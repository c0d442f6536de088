"""Figures of the report and the workbook: one module for each kind of result.

Tables come in, Matplotlib figures go out; `style` gives all of them the same look, and `layout`
gives their words room. No file is written. Matplotlib is imported by what draws and not by these
modules: a page whose figures are kept does not need it.
"""
