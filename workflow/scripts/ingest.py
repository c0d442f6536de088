"""Ingest one specimen: raw files → tidy curve and the record of how it came about."""

from pathlib import Path
from typing import Any

from nptcs.config.ingest import IngestSettings
from nptcs.console import clear_errors
from nptcs.errors import InputError
from nptcs.files import write_text
from nptcs.ingest import ingest_specimen, load_profiles
from nptcs.tables.curves import Curve, IngestRecord
from nptcs.tables.io import empty_table, write_table
from nptcs.tables.specimens import Specimen


def ingest(job: dict[str, Any], curve_file: str, record_file: str) -> None:
    specimen = Specimen.model_validate(job["specimen"])
    settings = IngestSettings.model_validate(job["settings"])
    folder, profiles = Path(job["folder"]), load_profiles(job["formats"])
    try:
        done = ingest_specimen(specimen, folder, settings, profiles)
        curve, record = done.curve, done.record
    except InputError as error:
        curve, record = empty_table(Curve), IngestRecord.failed(specimen.specimen, error)
    write_table(curve_file, curve, Curve)
    write_text(record_file, record.model_dump_json(indent=1))


if __name__ == "__main__":
    with clear_errors(snakemake.log[0]):
        ingest(snakemake.params.job, snakemake.output.curve, snakemake.output.record)
