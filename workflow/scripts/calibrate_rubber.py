"""Fit the hyperelastic models to the curves of one rubber."""

from typing import Any

from nptcs.calibrate import calibrate_rubber_tables
from nptcs.config.materials.calibration import CalibrationSettings
from nptcs.console import clear_errors
from nptcs.files import read_model, write_model
from nptcs.ingest.repeats import counted_once
from nptcs.tables.io import write_table
from nptcs.tables.laboratory.curves import IngestRecord, read_curves
from nptcs.tables.laboratory.hyperelastic import ModelComparison, RangeTable
from nptcs.tables.laboratory.specimens import Specimen


def calibrate(job: dict[str, Any], curves: list[str], records: list[str], **output: str) -> None:
    settings = CalibrationSettings.model_validate(job["settings"])
    outcomes = [read_model(file, IngestRecord) for file in records]
    sheet = [Specimen.model_validate(row) for row in job["specimens"]]
    data = (job["rubber"], read_curves(curves), counted_once(sheet, outcomes), settings, outcomes)
    card, models, ranges = calibrate_rubber_tables(*data)
    write_model(output["card"], card)
    write_table(output["models"], models, ModelComparison)
    write_table(output["ranges"], ranges, RangeTable)


if __name__ == "__main__":
    with clear_errors(snakemake.log[0]):
        calibrate(**snakemake.params, **snakemake.input, **snakemake.output)
