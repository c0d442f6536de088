"""Ingest a batch of specimens: raw files → tidy curves and the records of how they came about."""

import json
from collections.abc import Sequence
from typing import Any

from nptcs.config.ingest import IngestSettings
from nptcs.console import clear_errors
from nptcs.errors import InputError
from nptcs.files import sha256_of_file, sha256_of_text, write_model
from nptcs.ingest import ingest_specimen, load_profiles
from nptcs.ingest.kept import is_kept
from nptcs.tables.curves import Curve, IngestRecord
from nptcs.tables.io import empty_table, write_table
from nptcs.tables.specimens import Specimen


def ingest(job: dict[str, Any], curves: Sequence[str], records: Sequence[str]) -> None:
    settings, profiles = IngestSettings(**job["settings"]), load_profiles(job["formats"])
    rest = {key: value for key, value in job.items() if key != "specimens"}
    for row, curve, record in zip(job["specimens"], curves, records, strict=True):
        made_from = sha256_of_text(json.dumps([row, rest], sort_keys=True))
        if is_kept(curve, record, made_from):
            continue
        specimen = Specimen.model_validate(row["specimen"])
        try:
            done = ingest_specimen(specimen, job["folder"], settings, profiles)
            table, how = done.curve, done.record
        except InputError as error:
            table, how = empty_table(Curve), IngestRecord.failed(specimen.specimen, error)
        write_table(curve, table, Curve)
        made = {"made_from": made_from, "curve_sha256": sha256_of_file(curve)}
        write_model(record, how.model_copy(update=made))


if __name__ == "__main__":
    with clear_errors(snakemake.log[0]):
        ingest(**snakemake.params, **snakemake.output)
