"""Figures of the report and the workbook: one module for each kind of result.

Tables come in, Matplotlib figures go out; `style` gives all of them the same look, `layout` the room
for their words. No file is written. Matplotlib is imported by what draws and not by these modules:
a page whose figures are kept does not need it.
"""
