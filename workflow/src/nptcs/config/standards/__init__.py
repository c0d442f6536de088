"""The sections of the standards: each range with the standard's value as default.

One class for each standard; which one is in force is in `nptcs.config.reduction`.
"""
