"""Fit and compare the surfaces of one study, for each solver that answered."""

from typing import Any

from nptcs.campaign.cases import cases_table
from nptcs.campaign.record import read_records
from nptcs.compare.coefficients import by_powers
from nptcs.config.study import Study
from nptcs.console import clear_errors
from nptcs.files import read_model, write_text
from nptcs.surface.stored import dump, dump_models
from nptcs.surface.study import fit_study
from nptcs.surface.tables import comparison_tables, quality_table, surface_table
from nptcs.tables.io import read_tables, write_table
from nptcs.tables.material_card import PlyCard
from nptcs.tables.problems import Problems
from nptcs.tables.published_inputs import PublishedCoefficients
from nptcs.tables.surface import SurfaceByFactor, SurfaceComparison, SurfaceQuality, SurfaceTable


def fit(
    job: dict[str, Any], records: list[str], published: list[str], ply: list[str], **output: str
) -> None:
    study = Study.model_validate(job["study"])
    constants = next((read_model(card, PlyCard).values() for card in ply), None)
    done = fit_study(cases_table(read_records(records)), study, constants)
    factors = [factor.name for factor in study.factors]
    printed = by_powers(read_tables(published, PublishedCoefficients), factors)
    comparison, by_factor = comparison_tables(study.name, done)
    write_table(output["table"], surface_table(done.polynomials, printed), SurfaceTable)
    write_table(output["quality"], quality_table(study.name, done), SurfaceQuality)
    write_table(output["comparison"], comparison, SurfaceComparison)
    write_table(output["by_factor"], by_factor, SurfaceByFactor)
    write_table(output["problems"], done.problems, Problems)
    write_text(output["surfaces"], dump(done.polynomials))
    write_text(output["models"], dump_models(done.models))


if __name__ == "__main__":
    with clear_errors(snakemake.log[0]):
        fit(**snakemake.params, **snakemake.input, **snakemake.output)
