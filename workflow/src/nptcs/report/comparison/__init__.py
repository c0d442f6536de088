"""The comparison of two runs as a page and as a workbook, in the style of the report.

`nptcs.runs.compare.ComparedRuns` comes in, HTML text or the bytes of an XLSX file go out. What is
compared, and how, belongs to the room `runs`.
"""
