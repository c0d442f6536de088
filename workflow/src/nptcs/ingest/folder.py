"""A laboratory's folder: every file accounted for."""

from __future__ import annotations

import difflib
import unicodedata
from collections.abc import Iterable
from pathlib import Path

import pandas as pd

from nptcs.errors import InputError
from nptcs.files import sha256_of_file
from nptcs.tables.curves import IngestRecord
from nptcs.tables.files import Files
from nptcs.tables.specimens import Specimen, files_named, read_sheet

NOTES = ("readme", "readme.md", "readme.txt")
"""Names, in any case, of files that are notes to the reader and no test data."""


def raw_files(folder: Path) -> dict[str, Path]:
    """All files below a folder, by relative name in natural order.

    Hidden files are left out, and links that lead out of the folder.
    """
    found = {
        path.relative_to(folder).as_posix(): path
        for path in folder.rglob("*")
        if path.is_file()
        and not any(part.startswith(".") for part in path.relative_to(folder).parts)
        and _stays_inside(path, folder)
    }
    return dict(sorted(found.items(), key=lambda item: natural_key(item[0])))


def _stays_inside(path: Path, folder: Path) -> bool:
    """Tell whether a file lies in the folder itself, and not behind a link out of it."""
    return path.resolve().is_relative_to(folder.resolve())


def is_note(name: str) -> bool:
    """Tell whether a file of the folder is a README, by its relative name."""
    return name.rsplit("/", 1)[-1].casefold() in NOTES


def natural_key(name: str) -> tuple[tuple[int, int, str], ...]:
    """Sort key by which 2 comes before 11."""
    parts: list[tuple[int, int, str]] = []
    digits = ""
    for mark in name.casefold() + " ":
        if mark.isascii() and mark.isdigit():
            digits += mark
            continue
        if digits:
            parts.append((0, int(digits), ""))
            digits = ""
        parts.append((1, 0, mark))
    return tuple(parts)


def find_file(folder: Path, name: str) -> Path:
    """Find a file that the sheet names, also if its accents are stored another way.

    Raises
    ------
    InputError
        If it is missing; with the most similar name.
    """
    if (folder / name).is_file():
        return folder / name
    wanted = unicodedata.normalize("NFC", name)
    present = raw_files(folder)
    for other, path in present.items():
        if unicodedata.normalize("NFC", other) == wanted:
            return path
    near = difflib.get_close_matches(name, present, n=1)
    hint = f"; did you mean '{near[0]}'?" if near else ""
    raise InputError(f"file is missing{hint}", "correct the name in the sheet", folder / name)


def account_for_files(sheet: str | Path, records: Iterable[IngestRecord]) -> pd.DataFrame:
    """Say what became of every file of a laboratory's folder.

    Parameters
    ----------
    sheet : str or Path
        The specimen sheet; its folder is the one accounted for.
    records : iterable of IngestRecord
        Outcome of each specimen, those that failed included.

    Returns
    -------
    DataFrame
        `nptcs.tables.files.Files`: one row a file, in the folder or named by the sheet.
    """
    sheet = Path(sheet)
    specimens = {specimen.specimen: specimen for specimen in read_sheet(sheet)[0]}
    outcomes = {record.specimen: record for record in records}
    named = {unicodedata.normalize("NFC", name): ids for name, ids in files_named(sheet).items()}
    present = {
        unicodedata.normalize("NFC", name): path for name, path in raw_files(sheet.parent).items()
    }
    rows = []
    for name in [*present, *(name for name in named if name not in present)]:
        path = present.get(name)
        status, reason = _status(name, path, sheet, named.get(name, []), specimens, outcomes)
        rows.append(
            {
                "file": name,
                "status": status,
                "specimens": " ".join(dict.fromkeys(named.get(name, []))),
                "format": _format(name, named.get(name, []), outcomes),
                "reason": reason,
                "size_bytes": path.stat().st_size if path else 0,
                "sha256": sha256_of_file(path) if path else "",
            }
        )
    return Files.validate(pd.DataFrame(rows, columns=list(Files.to_schema().columns)))


def _status(
    name: str,
    path: Path | None,
    sheet: Path,
    ids: list[str],
    specimens: dict[str, Specimen],
    outcomes: dict[str, IngestRecord],
) -> tuple[str, str]:
    if path is not None and path.samefile(sheet):
        return "sheet", ""
    if path is None:
        return "missing", f"named for {', '.join(ids)}, but not in the folder"
    if not ids and is_note(name):
        return "note", "a README is a note, no test data"
    if not ids:
        return "not named", "no row of the sheet names it"
    good = [id_ for id_ in ids if id_ in outcomes and outcomes[id_].status == "ok"]
    included = [id_ for id_ in good if id_ in specimens and specimens[id_].include]
    if included:
        return "used", ""
    if good:
        return "left out", "; ".join(specimens[id_].reason for id_ in good if id_ in specimens)
    messages = [outcomes[id_].message for id_ in ids if id_ in outcomes]
    return "not understood", "; ".join(messages) or "its row in the sheet has an error"


def _format(name: str, ids: list[str], outcomes: dict[str, IngestRecord]) -> str:
    for id_ in ids:
        for file in outcomes[id_].files if id_ in outcomes else ():
            if unicodedata.normalize("NFC", file.path) == name:
                return file.format
    return ""
