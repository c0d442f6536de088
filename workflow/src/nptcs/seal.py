"""Text that can be checked for damage: it carries a checksum and the version of its format.

A JSON object carries its seal under the key `SEAL`; a file with one JSON object per line carries it
in its last line. The checksum protects against damage and careless edits, not against forgery.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping, Sequence
from typing import Any

SEAL = "_seal"
"""Key of the seal; no field of a stored record may have this name."""

FORMATS: Mapping[str, int] = {
    "BulkResults": 1,
    "CaseRecord": 1,
    "CaseRecords": 1,
    "Figure": 1,
    "FittedSurfaces": 2,
    "IngestRecord": 1,
    "MaterialCard": 1,
    "PlyCard": 1,
    "RubberCard": 1,
    "RunIdentity": 1,
    "SpokeSurrogate": 4,
    "StartFacts": 1,
    "Surfaces": 1,
}
"""Version of each format: raise it with any change of what the fields mean."""


class BrokenSealError(ValueError):
    """Not the text that was written: damaged, edited, or of another format or version."""


def sealed_object(content: Mapping[str, Any], kind: str) -> str:
    """Write a JSON object with its seal.

    Parameters
    ----------
    content : mapping
        Plain values; numbers must be finite.
    kind : str
        A key of `FORMATS`.

    Returns
    -------
    str
        Indented JSON; the seal is its first key.

    Raises
    ------
    ValueError
        For a number that is not finite, which JSON does not have.

    Examples
    --------
    >>> text = sealed_object({"points": 16}, "Surfaces")
    >>> open_object(text, "Surfaces")
    {'points': 16}
    >>> open_object(text.replace("16", "17"), "Surfaces")
    Traceback (most recent call last):
    nptcs.seal.BrokenSealError: the content does not match its checksum: it was edited or damaged
    """
    seal = {"format": kind, "version": FORMATS[kind], "sha256": _sha256(_canonical(content))}
    return json.dumps({SEAL: seal, **content}, indent=1, ensure_ascii=False, allow_nan=False) + "\n"


def open_object(text: str, kind: str, by_hand: bool = False) -> dict[str, Any]:
    """Read what `sealed_object` wrote, without its seal.

    Line breaks and blanks between the values do not count.

    Parameters
    ----------
    text : str
        A JSON object.
    kind : str
        A key of `FORMATS`.
    by_hand : bool
        Whether a text without any seal, as a user may write it, is accepted.

    Raises
    ------
    BrokenSealError
        If it is not a JSON object, has no seal, or the seal does not match.
    """
    content = _object(text)
    if by_hand and SEAL not in content:
        return content
    seal = content.pop(SEAL, None)
    try:
        _check(seal, kind, _canonical(content))
    except (ValueError, RecursionError) as error:
        raise BrokenSealError(str(error)) from None
    return content


def sealed_lines(rows: Sequence[str], kind: str) -> str:
    """Join JSON texts, one per line, followed by a line with the seal.

    Parameters
    ----------
    rows : sequence of str
        JSON objects without line breaks.
    kind : str
        A key of `FORMATS`.

    Returns
    -------
    str
        The rows and the seal, each on its own line.
    """
    above = "".join(f"{row}\n" for row in rows)
    seal = {"format": kind, "version": FORMATS[kind], "rows": len(rows), "sha256": _sha256(above)}
    return above + json.dumps({SEAL: seal}) + "\n"


def open_lines(text: str, kind: str) -> list[str]:
    """Read what `sealed_lines` wrote: the rows without the seal.

    Raises
    ------
    BrokenSealError
        If a row was lost, doubled, edited or moved, or the last line is not the seal.
    """
    *rows, last = text.removesuffix("\n").split("\n")  # a row may contain other line separators
    _check(_object(last).get(SEAL), kind, "".join(f"{row}\n" for row in rows))
    return rows


def _object(text: str) -> dict[str, Any]:
    """Parse a JSON object, in which every number is finite."""
    try:
        content = json.loads(text, parse_constant=_refuse)
    except RecursionError:
        raise BrokenSealError("it is nested too deeply") from None
    except json.JSONDecodeError as error:
        raise BrokenSealError(f"it is incomplete or not JSON: {error}") from None
    if not isinstance(content, dict):
        raise BrokenSealError("it is not a JSON object")
    return content


def _refuse(name: str) -> None:
    raise BrokenSealError(f"it contains {name} where a number is expected")


def _check(seal: object, kind: str, content: str) -> None:
    """Compare a seal with what it should be."""
    if not isinstance(seal, dict):
        raise BrokenSealError("it has no checksum: it is cut off, or an older version wrote it")
    if (seal.get("format"), seal.get("version")) != (kind, FORMATS[kind]):
        found = f"{seal.get('format')} {seal.get('version')}"
        raise BrokenSealError(f"it has format {found}, not {kind} {FORMATS[kind]}")
    if seal.get("sha256") != _sha256(content):
        raise BrokenSealError("the content does not match its checksum: it was edited or damaged")


def _canonical(content: Mapping[str, Any]) -> str:
    return json.dumps(content, sort_keys=True, separators=(",", ":"), allow_nan=False)


def _sha256(text: str) -> str:
    return hashlib.sha256(text.encode("utf-8", "surrogatepass")).hexdigest()
