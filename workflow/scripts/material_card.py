"""Join the cards of the ply and of all rubbers, and their tables."""

from collections.abc import Sequence
from pathlib import Path

import pandas as pd

from nptcs.console import clear_errors
from nptcs.files import write_text
from nptcs.tables.hyperelastic import ModelComparison, RangeTable
from nptcs.tables.io import empty_table, read_table, write_table
from nptcs.tables.material_card import MaterialCard, PlyCard, RubberCard


def join_cards(plies: Sequence[str], rubbers: Sequence[str]) -> MaterialCard:
    ply_cards = [PlyCard.model_validate_json(Path(file).read_text("utf-8")) for file in plies]
    rubber_cards = [
        RubberCard.model_validate_json(Path(file).read_text("utf-8")) for file in rubbers
    ]
    return MaterialCard(
        plies={card.name: card for card in ply_cards},
        rubbers={card.name: card for card in rubber_cards},
    )


def join_tables(files: Sequence[str], contract: type, joined: str) -> None:
    tables = [read_table(file, contract) for file in files]
    write_table(joined, pd.concat(tables) if tables else empty_table(contract), contract)


if __name__ == "__main__":
    with clear_errors(snakemake.log[0]):
        source, output = snakemake.input, snakemake.output
        write_text(output.card, join_cards(source.ply, source.rubbers).model_dump_json(indent=1))
        join_tables(source.models, ModelComparison, output.models)
        join_tables(source.ranges, RangeTable, output.ranges)
