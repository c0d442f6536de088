"""Compare the load-bearing model with the published tables."""

from typing import Any

from nptcs.compare.lca import lca_against_fem, lca_validation, ring_neutral_lines
from nptcs.config.solvers.tyre import TyreGeometry
from nptcs.console import clear_errors
from nptcs.tables.io import read_table, write_table
from nptcs.tables.published import inputs as paper
from nptcs.tables.published.lca_validation import LcaAgainstFem, LcaNeutralLine, LcaValidation


def validate(job: dict[str, Any], validation: str, fem: str, neutral_line: str, **tables) -> None:
    tyre = TyreGeometry.model_validate(job["tyre"])
    band = {"shear_band_c10_mpa": job["shear_band_c10_mpa"]}
    table_7 = read_table(tables["table_7"], paper.PublishedRubberCases)
    table_10 = read_table(tables["table_10"], paper.PublishedSpokeStiffness)
    table_11 = read_table(tables["table_11"], paper.PublishedLcaAgainstFem)
    figure_15 = read_table(tables["figure_15"], paper.PublishedLcaErrors)
    rows = lca_validation(table_10, table_11, figure_15, tyre, **band)
    lines = ring_neutral_lines(table_10, table_11, tyre, **band)
    write_table(validation, rows, LcaValidation)
    write_table(fem, lca_against_fem(table_10, table_7, tyre), LcaAgainstFem)
    write_table(neutral_line, lines, LcaNeutralLine)


if __name__ == "__main__":
    with clear_errors(snakemake.log[0]):
        validate(**snakemake.params, **snakemake.input, **snakemake.output)
