"""The kinds of response surface next to the paper's polynomial.

Cases and the settings of a kind come in (`models.fit_surface`); a surface that predicts with an
interval goes out. The polynomial itself is in `surface.fit`, the choice of its terms in
`selection`; how far it can be trusted, in `diagnostics`.
"""
