"""From properties and curves to material cards.

Properties of specimens and rubber curves come in; the ply card, the rubber cards and the tables
that compare models and ranges go out: `calibrate_ply`, `calibrate_rubber`, `compare_models`,
`c10_against_range`. A test is not reduced here (`nptcs.reduce`), and no design is evaluated.
"""

from nptcs.calibrate.compare import c10_against_range, compare_models
from nptcs.calibrate.ply import calibrate_ply
from nptcs.calibrate.rubber import calibrate_rubber
from nptcs.calibrate.rubber_tables import calibrate_rubber_tables

__all__ = [
    "c10_against_range",
    "calibrate_ply",
    "calibrate_rubber",
    "calibrate_rubber_tables",
    "compare_models",
]
