"""Check the load-bearing model against the published tables."""

from typing import Any

import pandas as pd

from nptcs.config.tyre import TyreGeometry
from nptcs.console import clear_errors
from nptcs.lca.validation import lca_against_fem, lca_validation, ring_shape, table_11_state
from nptcs.tables.io import write_table
from nptcs.tables.lca_shape import LcaShape
from nptcs.tables.lca_validation import LcaAgainstFem, LcaValidation


def validate(job: dict[str, Any], source: dict[str, str], output: dict[str, str]) -> None:
    tyre = TyreGeometry.model_validate(job["tyre"])
    spokes = pd.read_csv(source["spoke_stiffness"])
    published = pd.read_csv(source["published"])
    rows = lca_validation(
        spokes, published, tyre, shear_band_c10_mpa=job["settings"]["shear_band_c10_mpa"]
    )
    write_table(output["validation"], rows, LcaValidation)
    fem = lca_against_fem(spokes, pd.read_csv(source["published_fem"]), tyre)
    write_table(output["fem"], fem, LcaAgainstFem)
    shapes = [
        ring_shape(table_11_state(spokes, tyre, c10)).assign(spoke_c10_mpa=c10)
        for c10 in published["spoke_c10_mpa"].astype(float)
    ]
    columns = list(LcaShape.to_schema().columns)
    write_table(output["shape"], pd.concat(shapes)[columns], LcaShape)


if __name__ == "__main__":
    with clear_errors(snakemake.log[0]):
        validate(
            snakemake.params.job, dict(snakemake.input.items()), dict(snakemake.output.items())
        )
