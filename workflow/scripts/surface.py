"""Fit and compare the surfaces of one study, for each solver that gave results."""

from typing import Any

from nptcs.campaign.cases import read_cases
from nptcs.compare.surface_tables import study_tables, write_surfaces
from nptcs.config.studies.study import Study
from nptcs.console import clear_errors
from nptcs.files import read_model
from nptcs.responses.study import study_responses
from nptcs.surface.study import fit_study
from nptcs.tables.io import read_tables, write_table
from nptcs.tables.laboratory.material_card import PlyCard
from nptcs.tables.published.inputs import PublishedCoefficients


def fit(job: dict[str, Any], records: list[str], **files: Any) -> None:
    study = Study.model_validate(job["study"])
    ply = next((read_model(card, PlyCard).values() for card in files["ply"]), None)
    values = study_responses(study, records, files["statistics"], job["responses"])
    done = fit_study(read_cases(records), study, ply, values)
    published = read_tables(files["published"], PublishedCoefficients)
    for name, (table, contract) in study_tables(study, done, published).items():
        write_table(files[name], table, contract)
    write_surfaces(done, files["surfaces"], files["models"])


if __name__ == "__main__":
    with clear_errors(snakemake.log[0]):
        fit(**snakemake.params, **snakemake.input, **snakemake.output)
