"""Results of many cases in one file: columns of numbers and texts, sealed with a checksum."""

from __future__ import annotations

import hashlib
import json
import zipfile
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from nptcs.errors import InputError
from nptcs.files import REWRITE, atomic_path
from nptcs.seal import FORMATS, BrokenSealError

KIND = "BulkResults"
HEADER = "header"
"""Array of the file that holds the seal and the order of the columns, as JSON."""


def write_bulk(path: str | Path, table: pd.DataFrame) -> None:
    """Write a table of results, atomically: numbers at full precision, the rest as text.

    Parameters
    ----------
    path : str or Path
        Ends in ``.npz``; equal tables give equal bytes.
    table : DataFrame
        Columns of floats, or of text without gaps.
    """
    arrays = {str(name): _packed(column) for name, column in table.items()}
    header = {
        "format": KIND,
        "version": FORMATS[KIND],
        "rows": len(table),
        "columns": list(arrays),
        "sha256": _checksum(arrays),
    }
    arrays[HEADER] = np.frombuffer(json.dumps(header).encode(), dtype=np.uint8)
    with atomic_path(path) as temporary:
        np.savez_compressed(temporary, allow_pickle=False, **arrays)


def read_bulk(path: str | Path) -> pd.DataFrame:
    """Read what `write_bulk` wrote.

    Raises
    ------
    InputError
        For a file that is missing, was cut off or edited, or is of another format.
    """
    if not Path(path).is_file():
        remedy = "run snakemake again; it writes this file again"
        raise InputError("this file of results does not exist", remedy, file=path)
    try:
        return _opened(path)
    except (BrokenSealError, zipfile.BadZipFile, ValueError, KeyError, EOFError, OSError) as error:
        reason = " ".join(str(error).splitlines()[:3])
        raise InputError(f"these results cannot be used: {reason}", REWRITE, path) from None


def _opened(path: str | Path) -> pd.DataFrame:
    with Path(path).open("rb") as stream, np.load(stream, allow_pickle=False) as stored:
        arrays = {name: stored[name] for name in stored.files}
    header: dict[str, Any] = json.loads(arrays.pop(HEADER).tobytes())
    if (header["format"], header["version"]) != (KIND, FORMATS[KIND]):
        found = f"{header['format']} {header['version']}"
        raise BrokenSealError(f"it has format {found}, not {KIND} {FORMATS[KIND]}")
    arrays = {name: arrays[name] for name in header["columns"]}
    if header["sha256"] != _checksum(arrays):
        raise BrokenSealError("the content does not match its checksum: it was edited or damaged")
    table = pd.DataFrame({name: _unpacked(values) for name, values in arrays.items()})
    if len(table) != header["rows"]:
        raise BrokenSealError(f"it has {len(table)} rows instead of {header['rows']}")
    return table


def _packed(column: pd.Series) -> np.ndarray:
    """Turn a column into an array: floats as they are, text as the bytes of a JSON list."""
    if pd.api.types.is_numeric_dtype(column) and not pd.api.types.is_bool_dtype(column):
        return column.to_numpy(np.float64)
    text = json.dumps([str(value) for value in column], ensure_ascii=False)
    return np.frombuffer(text.encode("utf-8", "surrogatepass"), dtype=np.uint8)


def _unpacked(values: np.ndarray) -> Any:
    if values.dtype == np.float64:
        return values
    return np.array(json.loads(values.tobytes().decode("utf-8", "surrogatepass")), dtype=object)


def _checksum(arrays: dict[str, np.ndarray]) -> str:
    digest = hashlib.sha256()
    for name, values in arrays.items():
        digest.update(json.dumps([name, str(values.dtype), len(values)]).encode())
        digest.update(values.tobytes())
    return digest.hexdigest()
