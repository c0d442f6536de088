"""Sobol indices and main effects of all surfaces."""

from pathlib import Path
from typing import Any

from nptcs.config.sensitivity import Sensitivity
from nptcs.console import clear_errors
from nptcs.surface.sobol_tables import variance_shares
from nptcs.surface.stored import read_models
from nptcs.tables.io import read_table, write_table
from nptcs.tables.problems import Problems
from nptcs.tables.sobol import MainEffects, SobolIndices
from nptcs.tables.surface import SurfaceQuality


def share(job: dict[str, Any], models: list[str], quality: str, **output: str) -> None:
    surfaces = {Path(file).stem: read_models(file) for file in models}
    failed = read_table(quality, SurfaceQuality).set_index(["study", "solver"])["failed_cases"]
    shares = variance_shares(
        surfaces, failed.to_dict(), Sensitivity.model_validate(job["settings"])
    )
    write_table(output["indices"], shares.indices, SobolIndices)
    write_table(output["effects"], shares.effects, MainEffects)
    write_table(output["problems"], shares.problems, Problems)


if __name__ == "__main__":
    with clear_errors(snakemake.log[0]):
        share(**snakemake.params, **snakemake.input, **snakemake.output)
