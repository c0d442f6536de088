"""The campaign: many solver cases, each isolated, each recorded, none solved twice.

A design table comes in (`jobs.make_jobs`), one record per case goes out (`runner.run_cases`), and
`cases.cases_table` makes one table of them. What a solver computes is not known here.
"""
