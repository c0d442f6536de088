"""Gather the deformed neutral lines of the cases that the studies name."""

from typing import Any

from nptcs.campaign.record import read_records
from nptcs.compare.neutral_line import case_ids, neutral_lines
from nptcs.console import clear_errors
from nptcs.tables.io import read_table, write_table
from nptcs.tables.tyres.cases import DesignTable
from nptcs.tables.tyres.neutral_line import NeutralLine


def gather(job: dict[str, Any], records: list[str], designs: list[str], lines: str) -> None:
    tables = [read_table(file, DesignTable) for file in designs]
    named = case_ids(tables, job["cases"])
    write_table(lines, neutral_lines(read_records(records), named), NeutralLine)


if __name__ == "__main__":
    with clear_errors(snakemake.log[0]):
        gather(**snakemake.params, **snakemake.input, **snakemake.output)
