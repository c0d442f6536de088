"""A finished study as one archive that can be checked and run again elsewhere.

A project folder with results comes in; a zip file in the form of an RO-Crate goes out, or the
faults of such an archive, or the differences between its tables and those of a second run. Nothing
is solved here; the code that makes the numbers belongs elsewhere.
"""
