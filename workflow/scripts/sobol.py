"""Sobol indices and main effects of all surfaces, and the ranks of every response's factors."""

from pathlib import Path
from typing import Any

import pandas as pd

from nptcs.config.sensitivity import Sensitivity
from nptcs.console import clear_errors
from nptcs.surface.response_tables import response_impacts
from nptcs.surface.sobol_tables import variance_shares
from nptcs.surface.stored import read_registry
from nptcs.surface.study import RESPONSE
from nptcs.tables.io import read_table, write_table
from nptcs.tables.problems import Problems
from nptcs.tables.response_surfaces import ResponseImpact
from nptcs.tables.sobol import MainEffects, SobolIndices
from nptcs.tables.surface import SurfaceQuality


def share(job: dict[str, Any], models: list[str], quality: str, **output: str) -> None:
    registries = {Path(file).stem: read_registry(file) for file in models}
    surfaces = {study: registry.by_solver(RESPONSE) for study, registry in registries.items()}
    failed = read_table(quality, SurfaceQuality).set_index(["study", "solver"])["failed_cases"]
    settings = Sensitivity.model_validate(job["settings"])
    shares = variance_shares(surfaces, failed.to_dict(), settings)
    ranked = response_impacts(list(registries.values()), settings)
    write_table(output["indices"], shares.indices, SobolIndices)
    write_table(output["effects"], shares.effects, MainEffects)
    write_table(output["impacts"], ranked.table, ResponseImpact)
    write_table(output["problems"], pd.concat([shares.problems, ranked.problems]), Problems)


if __name__ == "__main__":
    with clear_errors(snakemake.log[0]):
        share(**snakemake.params, **snakemake.input, **snakemake.output)
