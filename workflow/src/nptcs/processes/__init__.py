"""Processes of a run: which of them are alive, what they leave behind, how they end together.

Process numbers, signals and temporary folders come in; processes that are alive are named, and
what dead ones left is cleaned up. What a process computes does not belong here, nor do results.
Begin with `runs.begin_run` (the process of Snakemake) and `scratch.scratch_folder` (a process that
starts solver cases).
"""
