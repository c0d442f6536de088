"""Reduce the curves of one series to properties, by the standard of its test."""

from typing import Any

from nptcs.config.reduction import ReductionSettings
from nptcs.console import clear_errors
from nptcs.files import read_model
from nptcs.reduce.series import reduce_series
from nptcs.tables.curves import IngestRecord, read_curves
from nptcs.tables.io import write_table
from nptcs.tables.problems import Problems
from nptcs.tables.properties import PropertiesTable
from nptcs.tables.specimens import Specimen


def reduce(job: dict[str, Any], curves: list[str], records: list[str], **output: str) -> None:
    specimens = [Specimen.model_validate(row) for row in job["specimens"]]
    settings = ReductionSettings.model_validate(job["settings"])
    read = {record.specimen: record for record in (read_model(f, IngestRecord) for f in records)}
    properties, problems = reduce_series(specimens, read_curves(curves), read, settings)
    write_table(output["properties"], properties, PropertiesTable)
    write_table(output["problems"], problems, Problems)


if __name__ == "__main__":
    with clear_errors(snakemake.log[0]):
        reduce(**snakemake.params, **snakemake.input, **snakemake.output)
