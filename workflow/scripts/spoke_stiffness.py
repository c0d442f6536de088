"""Gather the single spokes: their curves, and their stiffness next to table 10."""

from typing import Any

from nptcs.campaign.record import read_records
from nptcs.compare.spoke_stiffness import spoke_curves, spoke_lines
from nptcs.console import clear_errors
from nptcs.tables.io import read_table, write_table
from nptcs.tables.published.inputs import PublishedSpokeStiffness
from nptcs.tables.tyres.spoke_stiffness import SpokeCurves, SpokeLines


def gather(job: dict[str, Any], records: list[str], published: list[str], **output: str) -> None:
    solved = read_records(records)
    tables = [read_table(file, PublishedSpokeStiffness) for file in published]
    table_10 = dict(zip(job["studies"], tables, strict=True))
    write_table(output["lines"], spoke_lines(solved, table_10), SpokeLines)
    write_table(output["curves"], spoke_curves(solved), SpokeCurves)


if __name__ == "__main__":
    with clear_errors(snakemake.log[0]):
        gather(**snakemake.params, **snakemake.input, **snakemake.output)
