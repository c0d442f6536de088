"""The open finite element route: a spoke in 3D, its energy table, the tyre on such spokes.

A design (section, plates, rubbers) comes in; forces, displacements and fields go out: `case` is the
entry point. What a solver must check in a case, and the form of its result, belong to
`nptcs.solvers`.
"""
