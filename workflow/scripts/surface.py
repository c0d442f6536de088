"""Fit the response surfaces of one study, one for each solver that answered."""

from typing import Any

from nptcs.campaign.cases import cases_table
from nptcs.campaign.record import read_records
from nptcs.compare.coefficients import by_powers
from nptcs.console import clear_errors
from nptcs.files import write_text
from nptcs.surface.stored import dump
from nptcs.surface.study import fit_study
from nptcs.surface.tables import quality_table, surface_table
from nptcs.tables.io import read_tables, write_table
from nptcs.tables.problems import Problems
from nptcs.tables.published_inputs import PublishedCoefficients
from nptcs.tables.surface import SurfaceQuality, SurfaceTable


def fit(job: dict[str, Any], records: list[str], published: list[str], **output: str) -> None:
    done = fit_study(cases_table(read_records(records)), **job["fit"])
    coefficients = by_powers(read_tables(published, PublishedCoefficients), job["fit"]["factors"])
    write_table(output["table"], surface_table(done.surfaces, coefficients), SurfaceTable)
    write_table(output["quality"], quality_table(job["fit"]["study"], done.quality), SurfaceQuality)
    write_table(output["problems"], done.problems, Problems)
    write_text(output["surfaces"], dump(done.surfaces))


if __name__ == "__main__":
    with clear_errors(snakemake.log[0]):
        fit(**snakemake.params, **snakemake.input, **snakemake.output)
