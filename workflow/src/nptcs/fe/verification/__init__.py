"""Models that only benchmarks and tests use: what the faster ones are measured against.

The same inputs as in `nptcs.fe.tyre` come in, the same results go out, with more unknowns. No study
and no solver imports from here.
"""
