"""Reduce the curves of one series to properties, by the standard of its test."""

from typing import Any

from nptcs.config.materials.ingest import Plausible
from nptcs.config.materials.reduction import ReductionSettings
from nptcs.console import clear_errors
from nptcs.files import read_model
from nptcs.reduce.series import reduce_series
from nptcs.tables.io import write_table
from nptcs.tables.laboratory.curves import IngestRecord, read_curves
from nptcs.tables.laboratory.properties import PropertiesTable
from nptcs.tables.laboratory.specimens import Specimen
from nptcs.tables.problems import Problems


def reduce(job: dict[str, Any], curves: list[str], records: list[str], **output: str) -> None:
    specimens = [Specimen.model_validate(row) for row in job["specimens"]]
    settings = ReductionSettings.model_validate(job["settings"])
    plausible = Plausible.model_validate(job["plausible"])
    read = {record.specimen: record for record in (read_model(f, IngestRecord) for f in records)}
    made = reduce_series(specimens, read_curves(curves), read, settings, plausible)
    write_table(output["properties"], made[0], PropertiesTable)
    write_table(output["problems"], made[1], Problems)


if __name__ == "__main__":
    with clear_errors(snakemake.log[0]):
        reduce(**snakemake.params, **snakemake.input, **snakemake.output)
