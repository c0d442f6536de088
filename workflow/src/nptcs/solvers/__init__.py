"""Solvers: one contract, one registry, one module or folder per solver."""
