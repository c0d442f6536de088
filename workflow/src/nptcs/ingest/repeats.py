"""The same data under two specimens: found by value, and counted once."""

from __future__ import annotations

import hashlib
from collections.abc import Iterable, Mapping, Sequence

import numpy as np

from nptcs.arrays import Array
from nptcs.ingest.reading.columns.names import LOADS, STRAINS
from nptcs.ingest.reading.raw_file import RawFile
from nptcs.ingest.sketch import ChangedCopies
from nptcs.tables.laboratory.curves import IngestRecord
from nptcs.tables.laboratory.specimens import Specimen

_DIGITS = 9
_SMALLEST_POWER = -300
"""Power of ten; the reciprocal of a smaller one is too large for a number."""


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


def records_that_repeat(
    records: Iterable[IngestRecord], pieces: Mapping[str, str] | None = None
) -> dict[str, str]:
    """Specimens that repeat the data of an earlier one: specimen → the first with these data.

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
    return records_that_repeat((by_name[name] for name in included if name in by_name), pieces)


def counted_once(specimens: Sequence[Specimen], records: Iterable[IngestRecord]) -> list[Specimen]:
    """Return the sheet with repeated data left out, with the reason.

    Only included specimens count, so leaving one out by hand keeps the other.
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
