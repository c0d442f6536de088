"""The open finite element route: a spoke in 3D, its energy table, the tyre on 60 of them.

A design (section, plates, rubbers) comes in, forces, displacements and fields go out: `case` is the
way in. What a solver must check of a case and the form of its result belong to `nptcs.solvers`.
"""
