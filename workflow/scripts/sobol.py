"""Sobol indices and main effects of all surfaces, and the ranks of every response's factors."""

from pathlib import Path
from typing import Any

from nptcs.config.studies.sensitivity import Sensitivity
from nptcs.console import clear_errors
from nptcs.surface.sensitivity.response_tables import sensitivity_tables
from nptcs.surface.stored import read_registry
from nptcs.tables.analysis.surface import SurfaceQuality
from nptcs.tables.io import read_table, write_table


def share(job: dict[str, Any], models: list[str], quality: str, **output: str) -> None:
    registries = {Path(file).stem: read_registry(file) for file in models}
    settings = Sensitivity.model_validate(job["settings"])
    found = sensitivity_tables(registries, read_table(quality, SurfaceQuality), settings)
    for name, (table, contract) in found.items():
        write_table(output[name], table, contract)


if __name__ == "__main__":
    with clear_errors(snakemake.log[0]):
        share(**snakemake.params, **snakemake.input, **snakemake.output)
