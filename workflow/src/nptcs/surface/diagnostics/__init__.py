"""How far a fitted surface can be trusted: tests, influence, left-out cases and levels.

Fitted surfaces and the cases of a design come in; tables of diagnostics go out. What the factors
do to a response is in `sensitivity`.
"""
