"""The seeded, synthetic example data: known truth, realistic files.

A seed comes in; the files of a whole test programme go out (`generate.generate`). The rest of
the package never looks at the truth that is kept here; only tests do.
"""
