"""Gather the single spokes: their curves, and the lines through the origin beside table 10."""

from collections.abc import Sequence
from typing import Any

from nptcs.campaign.record import read_records
from nptcs.compare.spoke_stiffness import spoke_curves, spoke_lines
from nptcs.console import clear_errors
from nptcs.tables.io import read_table, write_table
from nptcs.tables.published_inputs import PublishedSpokeStiffness
from nptcs.tables.spoke_stiffness import SpokeCurves, SpokeLines


def gather(
    job: dict[str, Any], records: Sequence[str], published: Sequence[str], lines: str, curves: str
) -> None:
    solved = read_records(list(records))
    printed = {
        study: read_table(file, PublishedSpokeStiffness)
        for study, file in zip(job["studies"], published, strict=True)
    }
    write_table(lines, spoke_lines(solved, printed), SpokeLines)
    write_table(curves, spoke_curves(solved), SpokeCurves)


if __name__ == "__main__":
    with clear_errors(snakemake.log[0]):
        gather(
            snakemake.params.job,
            snakemake.input.get("records", []),
            snakemake.input.get("published", []),
            snakemake.output.lines,
            snakemake.output.curves,
        )
