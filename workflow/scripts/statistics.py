"""Join the properties of all specimens and summarise each group."""

from typing import Any

from nptcs.config.materials.reduction import ReductionSettings
from nptcs.console import clear_errors
from nptcs.files import read_model
from nptcs.ingest.repeats import counted_once
from nptcs.reduce.result_tables import result_tables
from nptcs.tables.io import read_tables, write_table
from nptcs.tables.laboratory.curves import IngestRecord
from nptcs.tables.laboratory.properties import PropertiesTable
from nptcs.tables.laboratory.specimens import Specimen


def summarise(job: dict[str, Any], properties: list[str], records: list[str], **out: str) -> None:
    sheet = [Specimen.model_validate(row) for row in job["specimens"]]
    specimens = counted_once(sheet, (read_model(file, IngestRecord) for file in records))
    settings = ReductionSettings.model_validate(job["settings"])
    table = read_tables(properties, PropertiesTable)
    for name, (made, contract) in result_tables(table, specimens, settings).items():
        write_table(out[name], made, contract)


if __name__ == "__main__":
    with clear_errors(snakemake.log[0]):
        summarise(**snakemake.params, **snakemake.input, **snakemake.output)
