"""The same data under two specimens: found by value, and counted once."""

from __future__ import annotations

import hashlib
import re
from collections.abc import Iterable, Mapping, Sequence
from itertools import pairwise
from pathlib import Path

import numpy as np

from nptcs.arrays import Array
from nptcs.config.materials.ingest import FileLimits
from nptcs.errors import InputError
from nptcs.ingest.read_tables import read_tables
from nptcs.ingest.reading.columns.names import LOADS, STRAINS
from nptcs.ingest.reading.profiles import FormatProfile
from nptcs.ingest.reading.raw_file import RawFile
from nptcs.ingest.sketch import ChangedCopies, data_sketch
from nptcs.tables.laboratory.curves import IngestRecord
from nptcs.tables.laboratory.specimens import Specimen

_DIGITS = 9
_SMALLEST_POWER = -300
"""Of ten; the reciprocal of a smaller one is not a number."""
_HEADER_LIKE_ROWS = 10
_NO_TEXT = (b"PK\x03\x04", b"\xd0\xcf\x11\xe0", b"TDSm", b"MATL")
_NUMBER_BEGINS = re.compile(rb"(?:^|[\r\n])[ \t\"]*[-+.,]?\d")


def data_digest(tables: Sequence[RawFile]) -> str:
    """SHA-256 of the load and the strain as read, to nine digits: equal for equal tests.

    Bytes, format, unit, time and further channels do not count, so that a file saved again, or
    exported in another unit, is still the same data.
    """
    digest = hashlib.sha256()
    for table, names in ((tables[0], LOADS), (tables[-1], (*STRAINS, "displacement"))):
        name = next((name for name in names if name in table.values), None)
        if name is not None:
            digest.update(_rounded(table.values[name]))
        digest.update(b"\0")
    return digest.hexdigest()


def _rounded(readings: Array) -> bytes:
    """Mantissas of `_DIGITS` digits: a factor of ten between units leaves them as they are."""
    known = readings[~np.isnan(readings) & (readings != 0)]
    powers = np.floor(np.log10(np.abs(known))).astype(np.int64) - _DIGITS + 1
    powers = np.maximum(powers, _SMALLEST_POWER)
    lowest = powers.min(initial=0)
    tens = 10.0 ** np.arange(lowest, powers.max(initial=lowest) + 1)  # few: a power costs time
    mantissas = np.rint(known / tens[powers - lowest])
    whole = 10.0**_DIGITS  # 9.9999999999 rounds to the next power
    return (
        np.where(np.abs(mantissas) == whole, mantissas / 10, mantissas).astype(np.int64).tobytes()
    )


def repeats(
    records: Iterable[IngestRecord], pieces: Mapping[str, str] | None = None
) -> dict[str, str]:
    """Specimens whose data an earlier one has: specimen → the first one with these data.

    Parameters
    ----------
    records : iterable of IngestRecord
        In the order of the sheet.
    pieces : mapping of str to str, optional
        Specimen → piece of material; runs of one piece may share a file.
    """
    first: dict[str, str] = {}
    found: dict[str, str] = {}
    copies = ChangedCopies()
    for record in records:
        if not record.understood or not record.data_sha256:
            continue
        earlier = first.setdefault(record.data_sha256, record.specimen)
        if earlier == record.specimen:
            earlier = copies.earlier(record.specimen, record.data_sketch) or earlier
        piece = (pieces or {}).get(record.specimen, "")
        same_piece = piece and piece == (pieces or {}).get(earlier, "")
        if earlier != record.specimen and not same_piece:
            found[record.specimen] = earlier
    return found


def repeated_specimens(
    specimens: Sequence[Specimen], records: Iterable[IngestRecord]
) -> dict[str, str]:
    """Included specimens that repeat an earlier included one, in the order of the sheet."""
    included = {specimen.specimen: specimen for specimen in specimens if specimen.include}
    by_name = {record.specimen: record for record in records}
    pieces = {name: specimen.piece for name, specimen in included.items()}
    return repeats((by_name[name] for name in included if name in by_name), pieces)


def counted_once(specimens: Sequence[Specimen], records: Iterable[IngestRecord]) -> list[Specimen]:
    """Return the sheet with repeated data left out, with the reason.

    Only included specimens count, so that leaving one out by hand keeps the other.
    """
    again = repeated_specimens(specimens, records)
    return [
        specimen.model_copy(
            update={"include": False, "reason": f"the same data as {again[specimen.specimen]}"}
        )
        if specimen.specimen in again
        else specimen
        for specimen in specimens
    ]


def may_repeat(specimens: Sequence[Specimen], folder: Path) -> list[Specimen]:
    """Leave out specimens whose force file has another number of rows than every other one's.

    Rows are counted in the bytes; a header may be longer by some lines that look like readings.
    """
    counts = {s.specimen: _rows_of_numbers(folder / s.force_file) for s in specimens}
    ordered = sorted(counts.values())
    near = {
        one
        for low, high in pairwise(ordered)
        if high - low <= _HEADER_LIKE_ROWS
        for one in (low, high)
    }
    return [s for s in specimens if counts[s.specimen] in near]


def _rows_of_numbers(path: Path) -> int:
    """Count the lines that begin with a number; 0 for a workbook, which is then always read."""
    try:
        raw = path.read_bytes()
    except OSError:
        return 0
    if raw[:4] in _NO_TEXT or b"\x00" in raw[:1000]:
        return 0
    return len(_NUMBER_BEGINS.findall(raw))


def repeats_in_sheet(
    specimens: Sequence[Specimen],
    folder: Path,
    profiles: Mapping[str, FormatProfile],
    sheet: Path,
    limits: FileLimits,
) -> list[InputError]:
    """Report the included specimens that repeat another's data.

    Only files that may be equal are read. A specimen that cannot be read is passed over: the run
    reports it.
    """
    included = [specimen for specimen in specimens if specimen.include]
    records = []
    for specimen in may_repeat(included, folder):
        try:
            tables = read_tables(specimen, folder, profiles, limits)
        except InputError:
            continue
        record = IngestRecord(
            specimen=specimen.specimen,
            status="ok",
            data_sha256=data_digest(tables),
            data_sketch=data_sketch(tables),
        )
        records.append(record)
    return [
        InputError(
            f"the same data as specimen {first}",
            "name the right file, or set include to no; it is not counted twice",
            sheet,
            specimen=name,
        )
        for name, first in repeated_specimens(specimens, records).items()
    ]
