"""Reference models for benchmarks and tests, to check the faster models against.

The same inputs as in `nptcs.fe.tyre` come in and the same results go out, with more unknowns. No
study and no solver imports from here.
"""
