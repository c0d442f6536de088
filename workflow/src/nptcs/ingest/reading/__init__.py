"""Raw files as they are: bytes, text, tables, columns, quantities in units.

A file and the format profiles come in; a `raw_file.RawFile` in s, N, mm, MPa and strain goes out.
What the readings mean for a specimen belongs to `nptcs.ingest.conditioning`.
"""
