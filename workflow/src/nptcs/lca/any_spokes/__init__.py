"""The ring on spokes of any law, smeared or one by one: collocation of the same equations.

A section and a `nptcs.lca.spokes.law.SpokeLaw` come in, the loaded ring goes out (`with_law`). For
spokes of constant stiffness `nptcs.lca.linear` is exact and faster.
"""
