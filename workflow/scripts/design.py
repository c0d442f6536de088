"""Build the design table of one study."""

from collections.abc import Sequence
from typing import Any

from nptcs.config.solvers.tyre import TyreGeometry
from nptcs.config.studies.study import Study
from nptcs.console import clear_errors
from nptcs.design import build_design
from nptcs.files import read_model
from nptcs.tables.io import write_table
from nptcs.tables.laboratory.material_card import RubberCard
from nptcs.tables.tyres.cases import DesignTable


def build(job: dict[str, Any], design: str, cards: Sequence[str] = ()) -> None:
    rubbers = [read_model(card, RubberCard) for card in cards]
    c10_mpa = {rubber.name: rubber.constants["c10_mpa"].value for rubber in rubbers}
    tyre = TyreGeometry.model_validate(job["tyre"])
    write_table(
        design, build_design(Study.model_validate(job["study"]), c10_mpa, tyre), DesignTable
    )


if __name__ == "__main__":
    with clear_errors(snakemake.log[0]):
        build(**snakemake.params, **snakemake.input, **snakemake.output)
