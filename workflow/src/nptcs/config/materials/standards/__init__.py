"""The sections of the standards: each range with the standard's value as default.

One class per standard comes in from the configuration, checked ranges go out. Which standard is in
force is in `nptcs.config.materials.reduction`; how a curve is reduced by it is not known here.
"""
