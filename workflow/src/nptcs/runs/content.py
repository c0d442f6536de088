"""What a run consists of, by content: its input files, its tables and its material card."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from pathlib import Path

import pandas as pd

from nptcs.files import sha256_of_file
from nptcs.runs.identity import hashes_of_tables
from nptcs.tables.io import read_table
from nptcs.tables.laboratory.files import Files

CARD = "material_card.json"
FILES = "files.csv"


def inputs_of_run(
    folder: str, tables: Iterable[str | Path], named: Mapping[str, str]
) -> dict[str, str]:
    """Collect the input files of a run with their SHA-256.

    Parameters
    ----------
    folder : str
        The laboratory's folder, as the configuration names it.
    tables : iterable of str or Path
        All result tables; ``files.csv`` lists the files of the laboratory.
    named : mapping of str to str
        The SHA-256 of the files that the configuration names.
    """
    account = next((path for path in map(Path, tables) if path.name == FILES), None)
    raw = laboratory_files(read_table(account, Files), folder) if account else {}
    return dict(sorted({**raw, **named}.items()))


def laboratory_files(files: pd.DataFrame, folder: str) -> dict[str, str]:
    """Return the SHA-256 of the laboratory's files by their name in the project folder.

    Parameters
    ----------
    files : DataFrame
        `nptcs.tables.laboratory.files.Files`; a file that is missing has no hash and is left out.
    folder : str
        The laboratory's folder.
    """
    return {
        f"{folder}/{file}": str(digest)
        for file, digest in zip(files["file"], files["sha256"], strict=True)
        if digest
    }


def tables_of_run(tables: Iterable[str | Path], card: str | Path) -> dict[str, str]:
    """Hash all tables of a run and its material card, by their file names."""
    return {**hashes_of_tables(tables), CARD: sha256_of_file(card)}
