"""Tables as the report and the workbook show them: titles, headings, row classes, order.

Result tables come in, `sheets.Sheet` go out. Columns and their meaning are those of `nptcs.tables`.
"""
