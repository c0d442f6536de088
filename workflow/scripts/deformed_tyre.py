"""Draw the outlines of one loaded tyre."""

from pathlib import Path
from typing import Any

from nptcs.campaign.record import read_records
from nptcs.config.root import read_config
from nptcs.console import clear_errors
from nptcs.files import read_model
from nptcs.responses.deformed_tyre import outlines_of_study
from nptcs.tables.io import empty_table, read_table, write_table
from nptcs.tables.laboratory.material_card import PlyCard
from nptcs.tables.tyres.cases import DesignTable
from nptcs.tables.tyres.deformed_tyre import DeformedTyre


def draw(job: dict[str, Any], store: str, outlines: str, **files: Any) -> None:
    rows = empty_table(DeformedTyre)
    if job["study"]:
        config, records = read_config(files["config"]), read_records(files["records"])
        design = read_table(files["design"][0], DesignTable)
        ply = read_model(files["ply"][0], PlyCard).values()
        case = job["study"], job["solver"]
        rows = outlines_of_study(config, *case, records, design, ply, Path(store))
    write_table(outlines, rows, DeformedTyre)


if __name__ == "__main__":
    with clear_errors(snakemake.log[0]):
        draw(**snakemake.params, config=snakemake.config, **snakemake.input, **snakemake.output)
