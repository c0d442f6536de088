"""Finds Snakemake's way to `nptcs.monitor`: ``logger: [nptcs]`` in a profile."""

from nptcs.monitor.handler import RunHandler as LogHandler

__all__ = ["LogHandler"]
