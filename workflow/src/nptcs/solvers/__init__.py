"""Solvers: one contract, one registry, one module for each solver.

One case comes in (`contract.CaseInputs`), one result goes out (`contract.SolverResult`). Which
cases there are, and where results are kept, is not known here but in `nptcs.campaign`.
"""
