"""The report and the workbook: layout of finished results, nothing is computed here.

`data.Results` comes in, one HTML page (`html.render_report`) and one workbook
(`workbook.build_workbook`) go out. Which result tables there are, and where they are shown, is said
by `nptcs.tables.catalogue`.
"""
