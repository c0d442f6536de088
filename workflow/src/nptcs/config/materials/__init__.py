"""Configuration from raw files to material cards: conditioning, rules of reduction, calibration.

The settings of `nptcs.ingest`, `nptcs.reduce` and `nptcs.calibrate` come in and go out checked. The
standards have a room of their own; what is done with a setting does not belong here.
"""
