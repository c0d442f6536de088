"""Whether a specimen's curve and record still match its files, settings and code."""

from __future__ import annotations

from pathlib import Path

from nptcs.errors import InputError
from nptcs.files import read_model, sha256_of_file
from nptcs.tables.laboratory.curves import IngestRecord


def is_kept(curve: str | Path, record: str | Path, made_from: str) -> bool:
    """Tell whether everything that a curve and its record were made from is unchanged.

    Parameters
    ----------
    curve, record : str or Path
        Their files, as `nptcs.tables.io.write_table` and `nptcs.files.write_model` write them.
    made_from : str
        Hash of the row of the sheet, the content of its files, profiles, settings and code.

    Returns
    -------
    bool
        False as well where one of them is missing, damaged or edited.
    """
    if not Path(curve).is_file() or not Path(record).is_file():
        return False
    try:
        known = read_model(record, IngestRecord)
    except InputError:
        return False
    return known.made_from == made_from and known.curve_sha256 == sha256_of_file(curve)


def made_now(record: IngestRecord, made_from: str, curve: str | Path) -> IngestRecord:
    """Return a record that says what it and its curve, already a file, were made from."""
    return record.model_copy(update={"made_from": made_from, "curve_sha256": sha256_of_file(curve)})
