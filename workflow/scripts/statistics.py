"""Join the properties of all specimens and take the statistics of each group."""

from collections.abc import Sequence
from typing import Any

from nptcs.config.reduction import ReductionSettings
from nptcs.console import clear_errors
from nptcs.reduce.statistics import group_statistics
from nptcs.tables.io import read_tables, write_table
from nptcs.tables.properties import PropertiesTable
from nptcs.tables.specimens import Specimen
from nptcs.tables.statistics import StatisticsTable


def summarise(
    job: dict[str, Any], properties: Sequence[str], specimens: str, statistics: str
) -> None:
    sheet = [Specimen.model_validate(row) for row in job["specimens"]]
    settings = ReductionSettings.model_validate(job["settings"])
    table = read_tables(properties, PropertiesTable)
    write_table(specimens, table, PropertiesTable)
    write_table(statistics, group_statistics(table, sheet, settings), StatisticsTable)


if __name__ == "__main__":
    with clear_errors(snakemake.log[0]):
        summarise(**snakemake.params, **snakemake.input, **snakemake.output)
