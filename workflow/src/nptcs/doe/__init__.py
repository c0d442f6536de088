"""Design of experiments: points in coded units, [-1, 1] for each factor, without a study.

The number of factors and of cases comes in; points go out: `points`, `d_optimal`, `augment`, and
`whole_plates`, which moves spacings to values that can be built. Names and levels of factors
belong to `nptcs.design`.
"""
