"""Reduce the curves of one series to properties, by the standard of its test."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import pandas as pd

from nptcs.config.ingest import Plausible
from nptcs.config.reduction import ReductionSettings
from nptcs.console import clear_errors
from nptcs.errors import InputError
from nptcs.reduce import reduce_record
from nptcs.tables.curves import Curve, IngestRecord
from nptcs.tables.io import empty_table, read_table, write_table
from nptcs.tables.problems import Problems, problems_table
from nptcs.tables.properties import PropertiesTable
from nptcs.tables.specimens import Specimen


def reduce(
    job: dict[str, Any], curves: Sequence[str], records: Sequence[str], properties: str, faults: str
) -> None:
    settings = ReductionSettings.model_validate(job["settings"])
    plausible = Plausible.model_validate(job["plausible"])
    tables, problems = [], []
    for row, curve_file, record_file in zip(job["specimens"], curves, records, strict=True):
        specimen = Specimen.model_validate(row)
        record = IngestRecord.model_validate_json(Path(record_file).read_text("utf-8"))
        if record.status != "ok":
            continue  # listed as a problem of the stage `ingest`
        try:
            curve = read_table(curve_file, Curve)
            tables.append(reduce_record(curve, specimen, record, settings, plausible))
        except InputError as error:
            problems.append(("reduce", specimen.specimen, "", "error", str(error)))
    table = pd.concat(tables) if tables else empty_table(PropertiesTable)
    write_table(properties, table, PropertiesTable)
    write_table(faults, problems_table(problems), Problems)


if __name__ == "__main__":
    with clear_errors(snakemake.log[0]):
        reduce(
            snakemake.params.job,
            snakemake.input.curves,
            snakemake.input.records,
            snakemake.output.properties,
            snakemake.output.problems,
        )
