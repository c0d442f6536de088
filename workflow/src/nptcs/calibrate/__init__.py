"""From properties and curves to material cards."""

from nptcs.calibrate.ply import calibrate_ply
from nptcs.calibrate.rubber import calibrate_rubber

__all__ = ["calibrate_ply", "calibrate_rubber"]
