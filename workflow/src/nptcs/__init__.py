"""From raw test files to response surfaces for non-pneumatic tyres with composite spokes."""

__version__ = "0.1.0"
