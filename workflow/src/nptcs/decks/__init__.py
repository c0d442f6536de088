"""Input decks for solvers that the user has installed.

A case with its ply and its tyre comes in, the text of a deck goes out (`abaqus`, `calculix`).
Running a deck and reading its answer belong to `nptcs.solvers`.
"""
