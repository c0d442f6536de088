"""Collect everything that gave no result: sheet rows, specimens, cases, fits."""

from collections.abc import Sequence
from typing import Any

from nptcs.console import clear_errors
from nptcs.files import read_model
from nptcs.report.problems import all_problems
from nptcs.tables.io import read_table, read_tables, write_table
from nptcs.tables.laboratory.curves import IngestRecord
from nptcs.tables.problems import Problems
from nptcs.tables.tyres.cases import Cases


def collect(
    job: dict[str, Any],
    records: Sequence[str],
    cases: str,
    problems: str,
    tables: Sequence[str] = (),
) -> None:
    read = [read_model(file, IngestRecord) for file in records]
    found = read_tables(tables, Problems)
    table = all_problems(job["sheet_errors"], read, read_table(cases, Cases), found)
    write_table(problems, table, Problems)


if __name__ == "__main__":
    with clear_errors(snakemake.log[0]):
        collect(**snakemake.params, **snakemake.input, **snakemake.output)
