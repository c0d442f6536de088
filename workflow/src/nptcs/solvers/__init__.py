"""Solvers: one contract, one registry, one module or folder per solver.

One case comes in (`contract.CaseInputs`), one result goes out (`contract.SolverResult`). The
mathematics is in rooms of its own (`nptcs.fe`, `nptcs.lca`); a solver reads its options, calls it
and returns the result.
"""
