"""Tables of binary files: LabVIEW TDMS (npTDMS) and MATLAB MAT (scipy)."""

from __future__ import annotations

import io
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path

import numpy as np

from nptcs.arrays import Array
from nptcs.config.ingest import FileLimits
from nptcs.errors import InputError
from nptcs.ingest.reading.cells import SheetSource

TDMS = b"TDSm"
MAT = b"MATLAB 5.0 MAT-file"
MAT_HDF = b"MATLAB 7.3 MAT-file"
_UNIT_PROPERTIES = ("unit_string", "NI_UnitDescription", "Unit", "unit")

Columns = Mapping[str, Sequence[float] | Array]


def is_binary_table(raw: bytes) -> bool:
    """Tell whether this is TDMS or MAT content, whatever the suffix says."""
    return raw.startswith((TDMS, MAT, MAT_HDF))


def read_binary_table(
    path: Path, raw: bytes, missing: frozenset[str], limits: FileLimits
) -> list[SheetSource]:
    """Read the tables of a TDMS or MAT file, one source each.

    A TDMS group is a table; channels of another length are a table of their own. Units come from
    the channels' properties, and a time from their ``wf_increment`` where no channel holds one.
    In a MAT file, vectors of one length are a table under the names of the variables or of the
    fields of a structure; a matrix is a table without names.

    Raises
    ------
    InputError
        If it is damaged, larger than the limits, or of MATLAB's version 7.3.
    """
    if raw.startswith(MAT_HDF):
        raise InputError("is a MAT file of version 7.3", "save it with save(…, '-v7')", path)
    try:
        read = _tdms if raw.startswith(TDMS) else _mat
        tables = list(read(path, raw, limits))
    except InputError:
        raise
    except Exception as error:  # a damaged file: the libraries raise whatever they meet
        raise InputError(
            f"cannot be read: {type(error).__name__}: {error}", "export it again", path
        ) from error
    if not tables:
        raise InputError("cannot be read: it holds no columns of numbers", "export it again", path)
    return [SheetSource(path, name, rows, missing) for name, rows in tables]


def _table(name: str, columns: Columns) -> tuple[str, list[tuple[object, ...]]]:
    rows: list[tuple[object, ...]] = [tuple(columns)] if any(columns) else []
    return name, rows + list(zip(*(map(float, column) for column in columns.values()), strict=True))


def _refuse_larger(path: Path, rows: int, columns: int, limits: FileLimits) -> None:
    for what, size, allowed in (
        ("rows", rows, limits.rows),
        ("columns", columns, limits.columns),
    ):
        if size > allowed:
            raise InputError(
                f"has {size} {what}, {allowed} are allowed",
                f"export one test per file, or raise ingest.limits.{what}",
                path,
            )


def _tdms(
    path: Path, raw: bytes, limits: FileLimits
) -> Iterable[tuple[str, list[tuple[object, ...]]]]:
    from nptdms import TdmsFile

    with TdmsFile.open(io.BytesIO(raw)) as file:
        for group in file.groups():
            channels = [channel for channel in group.channels() if len(channel)]
            numeric = [channel for channel in channels if channel.dtype.kind in "iuf"]
            for length in dict.fromkeys(len(channel) for channel in numeric):
                same = [channel for channel in numeric if len(channel) == length]
                _refuse_larger(path, length, len(same), limits)
                columns: dict[str, Sequence[float] | Array] = {}
                for channel in same:
                    unit = next(
                        (
                            channel.properties[p]
                            for p in _UNIT_PROPERTIES
                            if channel.properties.get(p)
                        ),
                        "",
                    )
                    columns[f"{channel.name} [{unit}]" if unit else channel.name] = channel[:]
                step = same[0].properties.get("wf_increment")
                if step and not any("time" in name.casefold() for name in columns):
                    times = np.arange(length, dtype=np.float64) * float(step)
                    columns = {"time [s]": times, **columns}
                yield _table(group.name, columns)


def _mat(
    path: Path, raw: bytes, limits: FileLimits
) -> Iterable[tuple[str, list[tuple[object, ...]]]]:
    from scipy.io import loadmat, whosmat

    cells = 0
    for _, shape, _ in whosmat(io.BytesIO(raw)):
        cells += int(np.prod(shape))
        _refuse_larger(path, max(shape, default=0), 0, limits)
    if cells * 8 > limits.unpacked_mb * 1e6:
        raise InputError(
            f"unpacks to {cells * 8e-6:.4g} MB; {limits.unpacked_mb:g} MB are allowed",
            "check the file, or raise ingest.limits.unpacked_mb",
            path,
        )
    content = loadmat(io.BytesIO(raw), squeeze_me=True)
    variables = {
        name: np.asarray(value) for name, value in content.items() if not name.startswith("__")
    }
    structures = {name: value for name, value in variables.items() if value.dtype.names}
    yield from _vectors("", {n: v for n, v in variables.items() if n not in structures})
    for name, value in structures.items():
        fields = value.item() if value.ndim == 0 else None
        if fields is not None:
            named = zip(value.dtype.names or (), fields, strict=True)
            yield from _vectors(name, {field: np.asarray(one) for field, one in named})


def _vectors(
    name: str, variables: Mapping[str, np.ndarray]
) -> Iterable[tuple[str, list[tuple[object, ...]]]]:
    """Tables of the vectors of one length, and of each matrix."""
    numeric = {key: value for key, value in variables.items() if value.dtype.kind in "iuf"}
    vectors = {key: value for key, value in numeric.items() if value.ndim == 1 and len(value) > 1}
    for length in dict.fromkeys(len(value) for value in vectors.values()):
        yield _table(name, {key: one for key, one in vectors.items() if len(one) == length})
    for key, matrix in numeric.items():
        if matrix.ndim == 2 and min(matrix.shape) > 1:
            rows = [tuple(map(float, row)) for row in matrix]
            yield f"{name}.{key}" if name else key, rows  # type: ignore[misc]
