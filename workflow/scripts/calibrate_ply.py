"""Take the nine constants of one ply from the properties of its specimens."""

from collections.abc import Sequence
from typing import Any

import pandas as pd

from nptcs.calibrate import calibrate_ply
from nptcs.config.calibration import CalibrationSettings
from nptcs.console import clear_errors
from nptcs.files import write_text
from nptcs.ingest.repeats import counted_once
from nptcs.tables.curves import IngestRecord
from nptcs.tables.io import read_table
from nptcs.tables.properties import PropertiesTable
from nptcs.tables.specimens import Specimen


def calibrate(
    job: dict[str, Any], properties: Sequence[str], records: Sequence[str], card_file: str
) -> None:
    sheet = [Specimen.model_validate(row) for row in job["specimens"]]
    specimens = counted_once(sheet, map(IngestRecord.read, records))
    settings = CalibrationSettings.model_validate(job["settings"])
    table = pd.concat([read_table(file, PropertiesTable) for file in properties])
    card = calibrate_ply(table, specimens, settings, job["ply"])
    write_text(card_file, card.model_dump_json(indent=1))


if __name__ == "__main__":
    with clear_errors(snakemake.log[0]):
        calibrate(
            snakemake.params.job,
            snakemake.input.properties,
            snakemake.input.records,
            snakemake.output.card,
        )
