"""Join the properties of all specimens and take the statistics of each group."""

from collections.abc import Sequence
from typing import Any

import pandas as pd

from nptcs.config.reduction import ReductionSettings
from nptcs.console import clear_errors
from nptcs.ingest.repeats import counted_once
from nptcs.reduce.statistics import group_statistics
from nptcs.tables.curves import IngestRecord
from nptcs.tables.io import read_table, write_table
from nptcs.tables.properties import PropertiesTable
from nptcs.tables.specimens import Specimen
from nptcs.tables.statistics import StatisticsTable


def summarise(
    job: dict[str, Any],
    properties: Sequence[str],
    records: Sequence[str],
    joined: str,
    summary: str,
) -> None:
    sheet = [Specimen.model_validate(row) for row in job["specimens"]]
    specimens = counted_once(sheet, map(IngestRecord.read, records))
    settings = ReductionSettings.model_validate(job["settings"])
    table = pd.concat([read_table(file, PropertiesTable) for file in properties])
    table = table.reset_index(drop=True)
    write_table(joined, table, PropertiesTable)
    write_table(summary, group_statistics(table, specimens, settings), StatisticsTable)


if __name__ == "__main__":
    with clear_errors(snakemake.log[0]):
        summarise(
            snakemake.params.job,
            snakemake.input.properties,
            snakemake.input.records,
            snakemake.output.specimens,
            snakemake.output.statistics,
        )
