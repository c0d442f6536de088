"""The campaign: many solver cases, each isolated, each recorded, none solved twice.

A design table and a solver's name come in, one `record.CaseRecord` per case goes out; a case that
failed is a record too. How a solver computes does not belong here (`nptcs.solvers`). Begin with
`batch.solve_batch`.
"""
