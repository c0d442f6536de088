"""What a person sees of a run: one line that shows how far it is, each failure, and the end.

Snakemake's events come in (`handler.RunHandler` is its logger plugin), lines on the screen go out.
Snakemake's own words are in its log file. How a case is solved does not belong here, nor does
anything that takes long to import.
"""
