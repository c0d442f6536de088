"""One spoke: mesh, equilibrium, the energy table that represents it in the tyre, its pull and push.

A `SpokeDesign` comes in; states (`equilibrium`), an energy (`energy_table`) or a force–displacement
curve (`pull`) go out. Nothing here depends on the tyre.
"""
