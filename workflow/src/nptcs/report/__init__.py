"""The report and the workbook: layout of finished results, nothing is computed here."""
