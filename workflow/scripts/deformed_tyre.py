"""Draw the outlines of one loaded tyre."""

from typing import Any

from nptcs.campaign.record import read_records
from nptcs.config.root import read_config
from nptcs.console import clear_errors
from nptcs.files import read_model
from nptcs.responses.deformed_tyre import deformed_tyre
from nptcs.solvers.registry import load, module_of, read_options
from nptcs.tables.cases import Design
from nptcs.tables.deformed_tyre import DeformedTyre
from nptcs.tables.io import empty_table, read_table, write_table
from nptcs.tables.material_card import PlyCard


def draw(job: dict[str, Any], config: dict[str, Any], outlines: str, **files: Any) -> None:
    rows, whole = empty_table(DeformedTyre), read_config(config)
    if job["study"]:
        study, options = whole.study(job["study"]), whole.options_of(job["study"], job["solver"])
        design = read_table(files["design"][0], Design).set_index("case")["case_id"]
        rows = deformed_tyre(
            read_records(files["records"]),
            [design[number] for number in study.neutral_line_cases if number in design],
            read_options(load(module_of(job["solver"], options)), options),
            whole.tyre,
            read_model(files["ply"][0], PlyCard).values(),
        )
    write_table(outlines, rows, DeformedTyre)


if __name__ == "__main__":
    with clear_errors(snakemake.log[0]):
        draw(**snakemake.params, config=snakemake.config, **snakemake.input, **snakemake.output)
