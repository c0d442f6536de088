"""The workbook: the answer and an index, sheets of tables, native charts and a live predictor.

The results and their sheets (`report.tables`) come in; the bytes of one XLSX file go out. Numbers
stay native and whole, formulas are those of the fitted polynomials, and the same results give the
same bytes. What a table says belongs to `report.tables`; nothing is fitted or averaged here.
"""
