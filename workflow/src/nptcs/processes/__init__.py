"""Processes of a run: which of them live, what they leave behind, how they end together.

Process numbers, signals and temporary folders come in; what lives is named, what is dead is cleaned
up. What a process computes does not belong here, nor do results. Begin with `runs.begin_run` (the
process of Snakemake) and `scratch.scratch_folder` (a process that starts solver cases).
"""
