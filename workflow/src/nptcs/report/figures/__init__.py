"""Figures of the report and the workbook: one module for each kind of result.

Tables come in, Matplotlib figures go out; `style` gives all of them the same look. No file is
written.
"""
