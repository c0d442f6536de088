"""Names of solvers that tables and rules ask for."""

PUBLISHED = "published"
"""The solver with whose results the others are compared."""
