"""Gather the records of all cases in one table."""

from collections.abc import Sequence
from typing import Any

from nptcs.campaign.cases import read_cases
from nptcs.console import clear_errors
from nptcs.tables.io import write_table
from nptcs.tables.tyres.cases import Cases


def gather(job: dict[str, Any], records: Sequence[str], cases: str) -> None:
    write_table(cases, read_cases(records), Cases)


if __name__ == "__main__":
    with clear_errors(snakemake.log[0]):
        gather(**snakemake.params, **snakemake.input, **snakemake.output)
