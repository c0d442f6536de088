"""Arrays stored in a file that is trusted only if it is complete and of the right kind."""

from __future__ import annotations

import hashlib
import io
import struct
import zlib
from collections.abc import Mapping
from pathlib import Path
from typing import Any
from zipfile import BadZipFile

import numpy as np

from nptcs.arrays import Array
from nptcs.files import atomic_path

CHECKSUM = "sha256"
KIND = "kind"
# what numpy and zipfile raise on files that are empty, cut off or altered
UNREADABLE = (
    OSError,
    EOFError,
    ValueError,
    KeyError,
    IndexError,
    TypeError,
    BadZipFile,
    RuntimeError,
    OverflowError,
    MemoryError,
    SyntaxError,
    zlib.error,
    struct.error,
)


def write_arrays(path: Path, kind: str, arrays: Mapping[str, Any]) -> None:
    """Write arrays atomically, with their kind and a checksum over both.

    Parameters
    ----------
    path : Path
    kind : str
        What the file contains, with the version of its format and the key of its content.
    arrays : mapping of str to array
        Numbers only.
    """
    named: dict[str, Any] = {KIND: kind, CHECKSUM: _checksum(kind, arrays), **arrays}
    with atomic_path(path) as temporary, temporary.open("wb") as stream:
        np.savez(stream, **named)


def read_arrays(path: Path, kind: str) -> dict[str, Array] | None:
    """Read arrays that `write_arrays` wrote.

    Returns
    -------
    dict of str to array or None
        None if there is no such file, or it is incomplete, altered, of another kind, or contains
        a number that is not finite.
    """
    try:
        with np.load(io.BytesIO(path.read_bytes()), allow_pickle=False) as data:
            arrays = {name: np.asarray(data[name]) for name in data.files}
        labels = str(arrays.pop(KIND)), str(arrays.pop(CHECKSUM))
        sound = labels == (kind, _checksum(kind, arrays))
        finite = all(bool(np.isfinite(array).all()) for array in arrays.values())
    except UNREADABLE:
        return None
    return arrays if sound and finite else None


def _checksum(kind: str, arrays: Mapping[str, Any]) -> str:
    """SHA-256 over the kind and the names, types, shapes and bytes of the arrays."""
    whole = hashlib.sha256(kind.encode())
    for name in sorted(arrays):
        array = np.ascontiguousarray(arrays[name])
        whole.update(f"|{name}|{array.dtype.str}|{array.shape}|".encode())
        whole.update(array.tobytes())
    return whole.hexdigest()
