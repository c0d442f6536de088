"""Build the design table of one study."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from nptcs.config.study import Study
from nptcs.console import clear_errors
from nptcs.design import full_factorial
from nptcs.tables.cases import Design
from nptcs.tables.io import write_table
from nptcs.tables.material_card import RubberCard


def design(job: dict[str, Any], cards: Sequence[str], design_file: str) -> None:
    rubbers = [RubberCard.model_validate_json(Path(card).read_text("utf-8")) for card in cards]
    c10_mpa = {rubber.name: rubber.constants["c10_mpa"].value for rubber in rubbers}
    table = full_factorial(Study.model_validate(job["study"]), c10_mpa)
    write_table(design_file, table, Design)


if __name__ == "__main__":
    with clear_errors(snakemake.log[0]):
        design(snakemake.params.job, snakemake.input.get("cards", []), snakemake.output.design)
