"""Check the load-bearing model against the published tables."""

from typing import Any

from nptcs.compare.lca import lca_against_fem, lca_validation, ring_neutral_lines
from nptcs.config.tyre import TyreGeometry
from nptcs.console import clear_errors
from nptcs.tables.io import read_table, write_table
from nptcs.tables.lca_validation import LcaAgainstFem, LcaNeutralLine, LcaValidation
from nptcs.tables.published_inputs import (
    LcaAgainstFemPrinted,
    LoadErrors,
    PublishedSpokeStiffness,
    RubberCases,
)

CONTRACTS = {
    "spoke_stiffness": PublishedSpokeStiffness,
    "published": LcaAgainstFemPrinted,
    "published_loads": LoadErrors,
    "published_fem": RubberCases,
}


def validate(job: dict[str, Any], source: dict[str, str], output: dict[str, str]) -> None:
    tyre = TyreGeometry.model_validate(job["tyre"])
    band_c10_mpa = job["settings"]["shear_band_c10_mpa"]
    read = {name: read_table(source[name], contract) for name, contract in CONTRACTS.items()}
    spokes, table_11 = read["spoke_stiffness"], read["published"]
    rows = lca_validation(
        spokes, table_11, read["published_loads"], tyre, shear_band_c10_mpa=band_c10_mpa
    )
    write_table(output["validation"], rows, LcaValidation)
    fem = lca_against_fem(spokes, read["published_fem"], tyre)
    write_table(output["fem"], fem, LcaAgainstFem)
    lines = ring_neutral_lines(spokes, table_11, tyre, shear_band_c10_mpa=band_c10_mpa)
    write_table(output["neutral_line"], lines, LcaNeutralLine)


if __name__ == "__main__":
    with clear_errors(snakemake.log[0]):
        validate(
            snakemake.params.job, dict(snakemake.input.items()), dict(snakemake.output.items())
        )
