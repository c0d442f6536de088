"""Map of failed and missing cases by level of each factor."""

from pathlib import Path
from typing import Any

from nptcs.console import clear_errors
from nptcs.surface.diagnostics.coverage import Planned, coverage_table
from nptcs.tables.io import read_table, write_table
from nptcs.tables.tyres.cases import Cases, DesignTable
from nptcs.tables.tyres.coverage import CaseCoverage


def cover(job: dict[str, Any], cases: str, designs: list[str], coverage: str) -> None:
    studies = {
        Path(file).stem: Planned(read_table(file, DesignTable), **job["studies"][Path(file).stem])
        for file in designs
    }
    write_table(coverage, coverage_table(read_table(cases, Cases), studies), CaseCoverage)


if __name__ == "__main__":
    with clear_errors(snakemake.log[0]):
        cover(**snakemake.params, **snakemake.input, **snakemake.output)
