"""MATLAB's files: up to version 7 (scipy) and 7.3 (HDF5, h5py), and what Ncorr saves in them."""

from __future__ import annotations

import io
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

import numpy as np

from nptcs.arrays import Array
from nptcs.config.materials.ingest import FileLimits
from nptcs.errors import InputError
from nptcs.ingest.reading.native.tables import NativeTable, as_table, refuse_larger_table

MAT = b"MATLAB 5.0 MAT-file"
MAT_HDF = b"MATLAB 7.3 MAT-file"
NCORR = "data_dic_save"
"""Variable in which Ncorr saves displacements and strains."""
_NCORR_STRAINS = {"exx [1]": "plot_exx_ref_formatted", "eyy [1]": "plot_eyy_ref_formatted"}
_NUMBERS = "iuf"

Variables = dict[str, np.ndarray]


def matlab_tables(path: Path, raw: bytes, limits: FileLimits) -> Iterable[NativeTable]:
    """Read the tables of a MAT file of any version.

    Vectors of one length are a table under the names of the variables or of the fields of a
    structure; a matrix is a table without names. A file that Ncorr saved is one table of frames:
    the mean of exx and eyy (Lagrangian) over the points of its region of interest.

    Raises
    ------
    InputError
        If it unpacks to more than the limits.
    """
    read = _version_73 if raw.startswith(MAT_HDF) else _version_7
    variables, structures, frames = read(path, raw, limits)
    if frames:
        yield as_table("Ncorr", _means(frames))
        return
    yield from _vectors("", variables)
    for name, fields in structures.items():
        yield from _vectors(name, fields)


def _refuse_unpacked(path: Path, cells: int, limits: FileLimits) -> None:
    if cells * 8 > limits.unpacked_mb * 1e6:
        raise InputError(
            f"unpacks to {cells * 8e-6:.4g} MB; {limits.unpacked_mb:g} MB are allowed",
            "check the file, or raise ingest.limits.unpacked_mb",
            path,
        )


Content = tuple[Variables, dict[str, Variables], list[Variables]]


def _version_7(path: Path, raw: bytes, limits: FileLimits) -> Content:
    from scipy.io import loadmat, whosmat

    cells = 0
    for _, shape, _ in whosmat(io.BytesIO(raw)):
        cells += int(np.prod(shape))
        refuse_larger_table(path, max(shape, default=0), 0, limits)
    _refuse_unpacked(path, cells, limits)
    content = loadmat(io.BytesIO(raw), squeeze_me=True)
    variables = {
        name: np.asarray(value) for name, value in content.items() if not name.startswith("__")
    }
    if NCORR in variables:
        strains = np.atleast_1d(variables[NCORR].item()[_field(variables[NCORR], "strains")])
        frames = [
            {name: np.asarray(frame[field]) for name, field in _NCORR_STRAINS.items()}
            for frame in strains
        ]
        return {}, {}, frames
    structures = {
        name: {
            field: np.asarray(one)
            for field, one in zip(value.dtype.names or (), value.item(), strict=True)
        }
        for name, value in variables.items()
        if value.dtype.names and value.ndim == 0
    }
    return {n: v for n, v in variables.items() if not v.dtype.names}, structures, []


def _field(structure: np.ndarray, name: str) -> int:
    return list(structure.dtype.names or ()).index(name)


def _version_73(path: Path, raw: bytes, limits: FileLimits) -> Content:
    import h5py

    variables: Variables = {}
    structures: dict[str, Variables] = {}
    with h5py.File(io.BytesIO(raw), "r") as file:
        if NCORR in file:
            return {}, {}, _ncorr_73(path, file, limits)
        cells = 0
        for name, item in file.items():
            if name.startswith("#"):
                continue
            fields = item.items() if isinstance(item, h5py.Group) else [(name, item)]
            into = structures.setdefault(name, {}) if isinstance(item, h5py.Group) else variables
            for field, one in fields:
                if not isinstance(one, h5py.Dataset) or one.dtype.kind not in _NUMBERS:
                    continue
                cells += one.size
                refuse_larger_table(path, max(one.shape, default=0), 0, limits)
                _refuse_unpacked(path, cells, limits)
                into[field] = np.squeeze(one[()].T)  # MATLAB stores column by column
    return variables, structures, []


def _ncorr_73(path: Path, file: Any, limits: FileLimits) -> list[Variables]:
    """Read the strain fields of each frame: references, or one field where there is one frame."""
    columns, cells = {}, 0
    for name, field in _NCORR_STRAINS.items():
        stored = file[NCORR]["strains"][field]
        one_frame = stored.dtype.kind in _NUMBERS
        items = [stored] if one_frame else [file[place] for place in stored[()].ravel()]
        cells += sum(item.size for item in items)
        _refuse_unpacked(path, cells, limits)
        columns[name] = [item[()].T for item in items]
    return [
        dict(zip(columns, fields, strict=True)) for fields in zip(*columns.values(), strict=True)
    ]


def _means(frames: list[Variables]) -> Mapping[str, Array]:
    """Mean strains of each frame; Ncorr writes 0 outside its region of interest."""
    found = {"frame": np.arange(1, len(frames) + 1, dtype=np.float64)}
    inside = [np.logical_or.reduce([field != 0 for field in frame.values()]) for frame in frames]
    for name in _NCORR_STRAINS:
        found[name] = np.array(
            [
                np.nanmean(frame[name][rows]) if rows.any() else 0.0
                for frame, rows in zip(frames, inside, strict=True)
            ]
        )
    return found


def _names(variables: Variables) -> list[str]:
    """Names of a matrix's columns: the one list of words among the variables; else none."""
    lists = [
        [str(one).strip() for one in value]
        for value in variables.values()
        if value.ndim == 1 and (value.dtype.kind == "U" or _of_words(value))
    ]
    return lists[0] if len(lists) == 1 and len(set(lists[0])) == len(lists[0]) else []


def _of_words(value: np.ndarray) -> bool:
    return value.dtype.kind == "O" and all(isinstance(one, str) for one in value)


def _vectors(name: str, variables: Variables) -> Iterable[NativeTable]:
    """Tables of the vectors of one length, and of each matrix."""
    numeric = {key: value for key, value in variables.items() if value.dtype.kind in _NUMBERS}
    vectors = {key: value for key, value in numeric.items() if value.ndim == 1 and len(value) > 1}
    for length in dict.fromkeys(len(value) for value in vectors.values()):
        yield as_table(name, {key: one for key, one in vectors.items() if len(one) == length})
    names = _names(variables)
    for key, matrix in numeric.items():
        if matrix.ndim == 2 and matrix.shape[1] == len(names) > 1:
            columns = {one: np.asarray(matrix[:, i]) for i, one in enumerate(names)}
            yield as_table(f"{name}.{key}" if name else key, columns)
        elif matrix.ndim == 2 and min(matrix.shape) > 1:
            rows: list[tuple[object, ...]] = [tuple(map(float, row)) for row in matrix]
            yield f"{name}.{key}" if name else key, rows
