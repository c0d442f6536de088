"""Diagnostics of all polynomials: tests, analysis of variance, influence, stationary points."""

from pathlib import Path
from typing import Any

from nptcs.console import clear_errors
from nptcs.surface.diagnostics import tables
from nptcs.surface.stored import read_surfaces
from nptcs.tables.analysis import diagnostics as contracts
from nptcs.tables.io import write_table


def diagnose(job: dict[str, Any], surfaces: list[str], **output: str) -> None:
    fitted = {Path(file).stem: read_surfaces(file) for file in surfaces}
    write_table(output["tests"], tables.tests_table(fitted), contracts.SurfaceTests)
    write_table(output["anova"], tables.anova_table(fitted), contracts.SurfaceAnova)
    write_table(output["influence"], tables.influence_table(fitted), contracts.SurfaceInfluence)
    write_table(output["stationary"], tables.stationary_table(fitted), contracts.SurfaceStationary)
    write_table(output["selection"], tables.selection_table(fitted), contracts.SurfaceSelection)


if __name__ == "__main__":
    with clear_errors(snakemake.log[0]):
        diagnose(**snakemake.params, **snakemake.input, **snakemake.output)
