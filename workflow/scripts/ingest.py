"""Ingest one specimen: raw files → tidy curve and the record of how it came about."""

from typing import Any

from nptcs.config.ingest import IngestSettings
from nptcs.console import clear_errors
from nptcs.errors import InputError
from nptcs.files import write_model
from nptcs.ingest import ingest_specimen, load_profiles
from nptcs.tables.curves import Curve, IngestRecord
from nptcs.tables.io import empty_table, write_table
from nptcs.tables.specimens import Specimen


def ingest(job: dict[str, Any], curve: str, record: str) -> None:
    specimen = Specimen.model_validate(job["specimen"])
    settings, profiles = IngestSettings(**job["settings"]), load_profiles(job["formats"])
    try:
        done = ingest_specimen(specimen, job["folder"], settings, profiles)
        table, how = done.curve, done.record
    except InputError as error:
        table, how = empty_table(Curve), IngestRecord.failed(specimen.specimen, error)
    write_table(curve, table, Curve)
    write_model(record, how)


if __name__ == "__main__":
    with clear_errors(snakemake.log[0]):
        ingest(**snakemake.params, **snakemake.output)
