"""Take the nine constants of the ply from the properties of its specimens."""

from collections.abc import Sequence
from typing import Any

from nptcs.calibrate import calibrate_ply
from nptcs.config.calibration import CalibrationSettings
from nptcs.console import clear_errors
from nptcs.files import write_model
from nptcs.tables.io import read_tables
from nptcs.tables.properties import PropertiesTable
from nptcs.tables.specimens import Specimen


def calibrate(job: dict[str, Any], properties: Sequence[str], card: str) -> None:
    specimens = [Specimen.model_validate(row) for row in job["specimens"]]
    settings = CalibrationSettings.model_validate(job["settings"])
    ply = calibrate_ply(read_tables(properties, PropertiesTable), specimens, settings)
    write_model(card, ply)


if __name__ == "__main__":
    with clear_errors(snakemake.log[0]):
        calibrate(**snakemake.params, **snakemake.input, **snakemake.output)
