"""The report and the workbook: layout of finished results, nothing is computed here.

`data.Results` comes in, one HTML page (`html.render_report`) and one workbook
(`workbook.build_workbook`) go out. `nptcs.tables.catalogue` says which result tables there are and
where they are shown.
"""
