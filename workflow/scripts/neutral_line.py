"""Gather the deformed neutral lines of the cases that the studies name."""

from collections.abc import Sequence
from typing import Any

from nptcs.campaign.record import read_records
from nptcs.compare.neutral_line import neutral_lines
from nptcs.console import clear_errors
from nptcs.tables.cases import Design
from nptcs.tables.io import read_table, write_table
from nptcs.tables.neutral_line import NeutralLine


def gather(job: dict[str, Any], records: Sequence[str], designs: Sequence[str], lines: str) -> None:
    named = {
        case_id
        for numbers, file in zip(job["cases"], designs, strict=True)
        for case_id, number in read_table(file, Design)[["case_id", "case"]].to_numpy()
        if number in numbers
    }
    write_table(lines, neutral_lines(read_records(list(records)), named), NeutralLine)


if __name__ == "__main__":
    with clear_errors(snakemake.log[0]):
        gather(
            snakemake.params.job,
            snakemake.input.get("records", []),
            snakemake.input.get("designs", []),
            snakemake.output.lines,
        )
