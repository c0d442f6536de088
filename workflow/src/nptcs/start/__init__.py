"""What the rules must know before the first job, kept from one start of Snakemake to the next.

The configuration, the specimen sheet and the package's code come in; plain facts go out
(`facts.known_facts`): solvers, plies, tables, hashes. To find them the whole package is imported
(`survey`); a start at which nothing has changed reads them from a file instead. How a job computes
does not belong here.
"""
