"""Fit the hyperelastic models to the curves of one rubber."""

from collections.abc import Sequence
from typing import Any

from nptcs.calibrate import c10_against_range, calibrate_rubber, compare_models
from nptcs.config.calibration import CalibrationSettings
from nptcs.console import clear_errors
from nptcs.files import write_text
from nptcs.ingest.repeats import counted_once
from nptcs.reduce.origin import origins_of
from nptcs.tables.curves import Curve, IngestRecord
from nptcs.tables.hyperelastic import ModelComparison, RangeTable
from nptcs.tables.io import read_table, write_table
from nptcs.tables.specimens import Specimen


def calibrate(
    job: dict[str, Any], curves: Sequence[str], records: Sequence[str], output: dict[str, str]
) -> None:
    settings = CalibrationSettings.model_validate(job["settings"])
    outcomes = [IngestRecord.read(file) for file in records]
    sheet = [Specimen.model_validate(row) for row in job["specimens"]]
    specimens = counted_once(sheet, outcomes)
    read = {
        specimen.specimen: read_table(file, Curve)
        for specimen, file in zip(specimens, curves, strict=True)
    }
    usable = {name: curve for name, curve in read.items() if len(curve)}
    data = (job["rubber"], usable, specimens, settings)
    sources = {record.specimen: record.strain_source for record in outcomes}
    origins = origins_of(outcomes)
    card = calibrate_rubber(*data, sources, origins)
    write_text(output["card"], card.model_dump_json(indent=1))
    write_table(output["models"], compare_models(*data, origins), ModelComparison)
    write_table(output["ranges"], c10_against_range(*data, origins), RangeTable)


if __name__ == "__main__":
    with clear_errors(snakemake.log[0]):
        calibrate(
            snakemake.params.job,
            snakemake.input.curves,
            snakemake.input.records,
            dict(snakemake.output.items()),
        )
