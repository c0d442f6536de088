"""Bytes of a text file into text, with the reason for the encoding chosen."""

from __future__ import annotations

import codecs
from collections.abc import Iterable
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

from nptcs.errors import InputError

BYTE_ORDER_MARKS = {
    codecs.BOM_UTF8: "utf-8-sig",
    codecs.BOM_UTF16_LE: "utf-16",
    codecs.BOM_UTF16_BE: "utf-16",
}
CANDIDATES = ("cp1252", "cp1250", "cp1251", "gb18030", "cp932", "cp949")
"""Encodings of test machines that are not UTF-8; all agree on digits and separators."""
_GUESSED = ("cp1252", "cp1250", "gb18030")
"""Those that a detector may choose where no known word decides."""
HEAD_BYTES = 20_000


@dataclass(frozen=True)
class Decoded:
    """A file's text, the encoding, and why that encoding."""

    text: str
    encoding: str
    note: str


def decode(raw: bytes, path: Path, declared: str, words: Iterable[str]) -> Decoded:
    """Decode a text file.

    Parameters
    ----------
    raw : bytes
        The file's content.
    path : Path
        For messages.
    declared : str
        Encoding that a profile states; it wins. Empty: find it.
    words : iterable of str
        Column names and labels of all profiles: the encoding that yields most of them wins.

    Raises
    ------
    InputError
        If the file is empty or binary, or the declared encoding does not fit.
    """
    if not raw.strip():
        raise InputError("file is empty", "export the test again", path)
    for mark, encoding in BYTE_ORDER_MARKS.items():
        if raw.startswith(mark):
            return _strict(raw, encoding, path, "byte order mark")
    if b"\x00" in raw:
        return _wide(raw, path)
    if declared:
        return _strict(raw, declared, path, "declared by the profile")
    try:
        text = raw.decode("utf-8")
    except UnicodeDecodeError:
        return _eight_bit(raw, path, words)
    return Decoded(text, "ascii" if raw.isascii() else "utf-8", "valid")


def _strict(raw: bytes, encoding: str, path: Path, note: str) -> Decoded:
    try:
        return Decoded(raw.decode(encoding), encoding, note)
    except LookupError as error:
        raise InputError("unknown encoding", "e.g. utf-8, cp1252", path, value=encoding) from error
    except UnicodeDecodeError as error:
        line = raw[: error.start].count(b"\n") + 1
        raise InputError(
            f"is not {encoding} ({note})", "state the right encoding in the profile", path, line
        ) from error


def _wide(raw: bytes, path: Path) -> Decoded:
    """Two bytes per character without a mark, or not text at all."""
    for encoding, zeros in (("utf-16-le", raw[1::2]), ("utf-16-be", raw[0::2])):
        if len(raw) % 2 == 0 and zeros.count(0) > 0.8 * len(zeros):
            return _strict(raw, encoding, path, "every second byte is zero")
    raise InputError("is binary, not text", "export it as text or as XLSX", path)


def _eight_bit(raw: bytes, path: Path, words: Iterable[str]) -> Decoded:
    """Choose among `CANDIDATES` by the words that each makes readable."""
    head = raw[: raw.rfind(b"\n", 0, HEAD_BYTES) + 1] or raw
    head = b"\n".join(line for line in head.splitlines() if not line.isascii()) or head
    special = _special(frozenset(words))
    hits = {}
    for encoding in CANDIDATES:
        text = _or_none(head, encoding)
        if text is not None:
            folded = text.casefold()
            hits[encoding] = sum(word in folded for word in special)
    for encoding in sorted(hits, key=hits.__getitem__, reverse=True):
        text = _or_none(raw, encoding) if hits[encoding] else None
        if text is not None:
            note = f"{hits[encoding]} known words are readable; others: {hits}"
            return Decoded(text, encoding, note)
    return _unknown_words(raw, head, path)


@lru_cache(maxsize=4)
def _special(words: frozenset[str]) -> frozenset[str]:
    """Words that look different in other encodings, in lower case."""
    return frozenset(word.casefold() for word in words if not word.isascii() and _tells(word))


def _tells(word: str) -> bool:
    """Tell whether a word is too long to be read by chance: two ideographs, or three letters."""
    return len(word) >= (2 if any(ord(mark) > 0x2E80 for mark in word) else 3)


_C1 = bytes(range(0x80, 0xA0))


def _or_none(raw: bytes, encoding: str) -> str | None:
    if encoding == "cp1252" and len(raw.translate(None, _C1)) == len(raw):
        encoding = "latin-1"  # the same but for these bytes, and ten times as fast
    try:
        return raw.decode(encoding)
    except UnicodeDecodeError:
        return None


def _unknown_words(raw: bytes, head: bytes, path: Path) -> Decoded:
    """Ask charset-normalizer to choose from `_GUESSED`; numbers are ASCII in all of them."""
    from charset_normalizer import from_bytes

    guess = from_bytes(head, cp_isolation=list(_GUESSED)).best()
    text = _or_none(raw, guess.encoding) if guess is not None else None
    if guess is not None and text is not None:
        note = f"charset-normalizer, out of {', '.join(_GUESSED)}"
        return Decoded(text, guess.encoding, note)
    text = _or_none(raw, "cp1252")
    if text is not None:
        return Decoded(text, "cp1252", "no known word, Western Europe assumed")
    text = raw.decode("utf-8", errors="replace")
    if text.count("\ufffd") > 0.05 * len(text):
        raise InputError("is not text in a known encoding", "state it in a profile", path)
    return Decoded(text, "utf-8 (damaged)", "bytes that are not text are shown as \ufffd")
