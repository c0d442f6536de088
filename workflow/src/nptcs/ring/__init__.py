"""The tyre as a sandwich ring on the spokes' energies: finite element results in milliseconds.

The band, its wires and the tread are a geometrically exact ring of two-node elements; each spoke is
the energy table that the solver `fe_tyre` uses. ``docs/methods/ring.md`` has the equations and says
when to use this model. A section, spokes' energies and loads come in; load curves and
gradients go out (`solution`, `batch`, `gradient`). Spokes are not solved here.
"""
