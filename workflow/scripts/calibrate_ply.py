"""Make the card of one ply from the properties of its specimens."""

from typing import Any

from nptcs.calibrate import calibrate_ply
from nptcs.config.materials.calibration import CalibrationSettings
from nptcs.console import clear_errors
from nptcs.files import read_model, write_model
from nptcs.ingest.repeats import counted_once
from nptcs.tables.io import read_tables
from nptcs.tables.laboratory.curves import IngestRecord
from nptcs.tables.laboratory.properties import PropertiesTable
from nptcs.tables.laboratory.specimens import Specimen


def calibrate(job: dict[str, Any], properties: list[str], records: list[str], card: str) -> None:
    sheet = [Specimen.model_validate(row) for row in job["specimens"]]
    specimens = counted_once(sheet, (read_model(file, IngestRecord) for file in records))
    settings = CalibrationSettings.model_validate(job["settings"])
    table = read_tables(properties, PropertiesTable)
    write_model(card, calibrate_ply(table, specimens, settings, job["ply"]))


if __name__ == "__main__":
    with clear_errors(snakemake.log[0]):
        calibrate(**snakemake.params, **snakemake.input, **snakemake.output)
