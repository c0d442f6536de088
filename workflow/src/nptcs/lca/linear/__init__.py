"""Spokes of constant stiffness: the ring's arcs solved exactly and joined to the contact region.

Designs in units of the ring come in (`scaling`), the angles and the state of the ring go out
(`newton`, `fields`, `diagnosis`). Lengths in mm and forces in N belong to `nptcs.lca`.
"""
