"""Fit the response surfaces of one study, one for each solver that answered."""

from collections.abc import Sequence
from typing import Any

from nptcs.campaign.cases import cases_table
from nptcs.campaign.record import read_records
from nptcs.compare.coefficients import by_powers
from nptcs.console import clear_errors
from nptcs.errors import InputError
from nptcs.files import write_text
from nptcs.surface.fit import Surface, fit
from nptcs.surface.quality import assess
from nptcs.surface.stored import dump
from nptcs.surface.tables import quality_table, surface_table
from nptcs.tables.io import read_table, write_table
from nptcs.tables.problems import Problems, problems_table
from nptcs.tables.published_inputs import PublishedCoefficients
from nptcs.tables.surface import SurfaceQuality, SurfaceTable


def fit_surfaces(
    study: dict[str, Any], records: Sequence[str], published: str | None, output: dict[str, str]
) -> None:
    cases = cases_table(read_records(list(records)))
    factors = [factor["name"] for factor in study["factors"]]
    printed = {}
    if published is not None:
        printed = by_powers(read_table(published, PublishedCoefficients), factors)
    surfaces: dict[str, Surface] = {}
    quality = {}
    problems = []
    for solver in study["solvers"]:
        solved = cases[(cases["solver"] == solver) & (cases["status"] == "ok")]
        try:
            stiffness = solved["vertical_stiffness_n_per_mm"]
            surfaces[solver] = fit(solved, stiffness, factors, study["terms"])
            quality[solver] = assess(surfaces[solver], solved, stiffness)
        except InputError as error:
            problems.append(("surface", study["name"], solver, "refused", str(error)))
    write_table(output["table"], surface_table(surfaces, printed), SurfaceTable)
    write_table(output["quality"], quality_table(study["name"], quality), SurfaceQuality)
    write_table(output["problems"], problems_table(problems), Problems)
    write_text(output["surfaces"], dump(surfaces))


if __name__ == "__main__":
    with clear_errors(snakemake.log[0]):
        fit_surfaces(
            snakemake.params.job["study"],
            snakemake.input.records,
            next(iter(snakemake.input.get("published", [])), None),
            dict(snakemake.output.items()),
        )
