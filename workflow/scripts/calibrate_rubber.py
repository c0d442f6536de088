"""Fit the hyperelastic models to the curves of one rubber."""

from typing import Any

from nptcs.calibrate import c10_against_range, calibrate_rubber, compare_models
from nptcs.config.calibration import CalibrationSettings
from nptcs.console import clear_errors
from nptcs.files import read_model, write_model
from nptcs.tables.curves import IngestRecord, read_curves
from nptcs.tables.hyperelastic import ModelComparison, RangeTable
from nptcs.tables.io import write_table
from nptcs.tables.specimens import Specimen


def calibrate(job: dict[str, Any], curves: list[str], records: list[str], **output: str) -> None:
    settings = CalibrationSettings.model_validate(job["settings"])
    specimens = [Specimen.model_validate(row) for row in job["specimens"]]
    usable = {name: curve for name, curve in read_curves(curves).items() if len(curve)}
    outcomes = [read_model(file, IngestRecord) for file in records]
    sources = {record.specimen: record.strain_source for record in outcomes}
    data = (job["rubber"], usable, specimens, settings)
    write_model(output["card"], calibrate_rubber(*data, sources))
    write_table(output["models"], compare_models(*data), ModelComparison)
    write_table(output["ranges"], c10_against_range(*data), RangeTable)


if __name__ == "__main__":
    with clear_errors(snakemake.log[0]):
        calibrate(**snakemake.params, **snakemake.input, **snakemake.output)
