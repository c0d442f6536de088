"""From properties and curves to material cards."""

from nptcs.calibrate.compare import c10_against_range, compare_models
from nptcs.calibrate.ply import calibrate_ply
from nptcs.calibrate.rubber import calibrate_rubber

__all__ = ["c10_against_range", "calibrate_ply", "calibrate_rubber", "compare_models"]
