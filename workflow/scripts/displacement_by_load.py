"""Read displacements at figure 15's loads from the curves of the solved tyres."""

from typing import Any

from nptcs.console import clear_errors
from nptcs.responses.displacement_by_load import displacement_by_load
from nptcs.tables.io import read_table, write_table
from nptcs.tables.published.lca_validation import LcaValidation
from nptcs.tables.tyres.cases import Cases
from nptcs.tables.tyres.displacement_by_load import DisplacementByLoad
from nptcs.tables.tyres.tyre_responses import TyreCurves


def compare(job: dict[str, Any], cases: str, curves: str, validation: str, table: str) -> None:
    rows = displacement_by_load(
        read_table(cases, Cases),
        read_table(curves, TyreCurves),
        read_table(validation, LcaValidation),
        job["shear_band_c10_mpa"],
    )
    write_table(table, rows, DisplacementByLoad)


if __name__ == "__main__":
    with clear_errors(snakemake.log[0]):
        compare(**snakemake.params, **snakemake.input, **snakemake.output)
