"""Response surfaces, such as equations 21 and 22 of the paper, and what follows from them.

Solved cases come in; fitted surfaces (`fit.fit`, and other `kinds`), their `diagnostics` and the
`sensitivity` of responses go out. `registry` finds a surface by its response, `stored` keeps all
in a file. The published coefficients are compared in `nptcs.compare`; no case is solved here.
"""
