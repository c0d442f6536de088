"""Solvers: one contract, one registry, one module or folder per solver.

One case comes in (`contract.CaseInputs`), one result goes out (`contract.SolverResult`). The
mathematics is in separate packages (`nptcs.fe`, `nptcs.lca`); a solver reads its options, calls
them and returns the result.
"""
