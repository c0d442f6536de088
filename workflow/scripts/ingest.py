"""Ingest a batch of specimens: raw files → tidy curves and the records of how they were made."""

import json
from typing import Any

from nptcs.config.materials.ingest import IngestSettings
from nptcs.console import clear_errors
from nptcs.files import sha256_of_text, write_model
from nptcs.ingest import ingest_or_record, load_profiles
from nptcs.ingest.kept import is_kept, made_now
from nptcs.tables.io import write_table
from nptcs.tables.laboratory.curves import Curve
from nptcs.tables.laboratory.specimens import Specimen


def ingest(job: dict[str, Any], curves: list[str], records: list[str]) -> None:
    given = job["folder"], IngestSettings(**job["settings"]), load_profiles(job["formats"])
    rest = {key: value for key, value in job.items() if key != "specimens"}
    for row, curve, record in zip(job["specimens"], curves, records, strict=True):
        made_from = sha256_of_text(json.dumps([row, rest], sort_keys=True))
        if is_kept(curve, record, made_from):
            continue
        done = ingest_or_record(Specimen.model_validate(row["specimen"]), *given)
        write_table(curve, done.curve, Curve)
        write_model(record, made_now(done.record, made_from, curve))


if __name__ == "__main__":
    with clear_errors(snakemake.log[0]):
        ingest(**snakemake.params, **snakemake.output)
