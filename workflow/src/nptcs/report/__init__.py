"""The report and the workbook: layout of finished results, nothing is computed here.

`data.Results` come in, a page (`html.render_report`) and a workbook (`workbook.build_workbook`) go
out. A number that is in no table of the run does not belong in either.
"""
