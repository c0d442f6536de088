"""Polynomial response surfaces, as equations 21 and 22 of the paper."""
