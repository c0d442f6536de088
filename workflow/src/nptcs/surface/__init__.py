"""Response surfaces, as equations 21 and 22 of the paper, and what follows from them.

Solved cases come in, fitted surfaces (`fit.fit`), their quality and sensitivities go out. The
published coefficients are compared in `nptcs.compare`; no case is solved here.
"""
