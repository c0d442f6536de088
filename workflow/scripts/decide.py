"""Answer the decisions, confirm them, and assess the uncertainty of reference and choice."""

from pathlib import Path
from typing import Any

from nptcs.config.root import read_config
from nptcs.console import clear_errors
from nptcs.decisions.result_tables import result_tables
from nptcs.decisions.run import read_solved_studies
from nptcs.tables.io import write_table


def decide(job: dict[str, Any], store: str, models: list[str], **files: Any) -> None:
    run = read_solved_studies(read_config(files["config"]), files, models, Path(job["added"]))
    for name, (table, contract) in result_tables(run, Path(store), files["cores"]).items():
        write_table(files[name], table, contract)


if __name__ == "__main__":
    granted = {"config": snakemake.config, "cores": snakemake.threads}
    with clear_errors(snakemake.log[0]):
        decide(**snakemake.params, **granted, **snakemake.input, **snakemake.output)
