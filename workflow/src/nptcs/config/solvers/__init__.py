"""Configuration of the models: the tyre's dimensions, and the options of each solver.

What a laboratory may change of a model is here. Which cases are solved is decided in
`nptcs.config.studies`.
"""
