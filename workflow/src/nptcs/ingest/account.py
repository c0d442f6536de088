"""Every file of a laboratory's folder accounted for."""

from __future__ import annotations

import unicodedata
from collections.abc import Iterable
from pathlib import Path

import pandas as pd

from nptcs.files import sha256_of_file
from nptcs.ingest.folder import is_note, raw_files
from nptcs.ingest.repeats import repeated_specimens
from nptcs.tables.laboratory.curves import IngestRecord
from nptcs.tables.laboratory.files import Files, FileStatus
from nptcs.tables.laboratory.specimens import Specimen, files_named, read_sheet


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
        `nptcs.tables.laboratory.files.Files`: one row per file that is in the folder or named by
        the sheet.
    """
    sheet = Path(sheet)
    specimens = {specimen.specimen: specimen for specimen in read_sheet(sheet)[0]}
    outcomes = {record.specimen: record for record in records}
    again = repeated_specimens(list(specimens.values()), outcomes.values())
    named = {unicodedata.normalize("NFC", name): ids for name, ids in files_named(sheet).items()}
    present = {
        unicodedata.normalize("NFC", name): path for name, path in raw_files(sheet.parent).items()
    }
    rows = []
    for name in [*present, *(name for name in named if name not in present)]:
        path = present.get(name)
        status, reason = _status(name, path, sheet, named.get(name, []), specimens, outcomes, again)
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
    again: dict[str, str],
) -> tuple[FileStatus, str]:
    if path is not None and path.samefile(sheet):
        return FileStatus.SHEET, ""
    if path is None:
        return FileStatus.MISSING, f"named for {', '.join(ids)}, but not in the folder"
    if ids:
        return _status_as_read(ids, specimens, outcomes, again)
    if is_note(name):
        return FileStatus.NOTE, "a README is a note, not test data"
    return FileStatus.NOT_NAMED, "no row of the sheet names it"


def _status_as_read(
    ids: list[str],
    specimens: dict[str, Specimen],
    outcomes: dict[str, IngestRecord],
    again: dict[str, str],
) -> tuple[FileStatus, str]:
    """Say what became of a file that the sheet names for these specimens."""
    good = [id_ for id_ in ids if id_ in outcomes and outcomes[id_].understood]
    included = [id_ for id_ in good if id_ in specimens and specimens[id_].include]
    repeats = [f"{id_} repeats the data of {again[id_]}" for id_ in included if id_ in again]
    if included:
        reason = "; ".join(repeats) + ", not counted again" if repeats else ""
        all_repeat = len(repeats) == len(included)
        return FileStatus.REPEATED if all_repeat else FileStatus.USED, reason
    if good:
        reasons = (specimens[id_].reason for id_ in good if id_ in specimens)
        return FileStatus.LEFT_OUT, "; ".join(reasons)
    messages = (outcomes[id_].message for id_ in ids if id_ in outcomes)
    return FileStatus.NOT_UNDERSTOOD, "; ".join(messages) or "its row in the sheet has an error"


def _format(name: str, ids: list[str], outcomes: dict[str, IngestRecord]) -> str:
    for id_ in ids:
        for file in outcomes[id_].files if id_ in outcomes else ():
            if unicodedata.normalize("NFC", file.path) == name:
                return file.format
    return ""
