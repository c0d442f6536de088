"""Join the cards of the ply and of all rubbers, and their tables."""

from typing import Any

from nptcs.console import clear_errors
from nptcs.files import read_model, write_model
from nptcs.tables.io import read_tables, write_table
from nptcs.tables.laboratory.hyperelastic import ModelComparison, RangeTable
from nptcs.tables.laboratory.material_card import MaterialCard, PlyCard, RubberCard


def join(job: dict[str, Any], card: str, models: str, ranges: str, **source: list[str]) -> None:
    plies = [read_model(file, PlyCard) for file in source["plies"]]
    rubbers = [read_model(file, RubberCard) for file in source["rubbers"]]
    write_model(card, MaterialCard.joined(plies, rubbers))
    write_table(models, read_tables(source["rubber_models"], ModelComparison), ModelComparison)
    write_table(ranges, read_tables(source["rubber_ranges"], RangeTable), RangeTable)


if __name__ == "__main__":
    with clear_errors(snakemake.log[0]):
        join(**snakemake.params, **snakemake.input, **snakemake.output)
