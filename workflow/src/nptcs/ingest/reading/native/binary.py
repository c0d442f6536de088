"""Tables of binary files: LabVIEW TDMS (npTDMS), and MATLAB's (module `matlab`)."""

from __future__ import annotations

import io
from collections.abc import Iterable, Sequence
from pathlib import Path

import numpy as np

from nptcs.arrays import Array
from nptcs.config.materials.ingest import FileLimits
from nptcs.errors import InputError
from nptcs.ingest.reading.native.matlab import MAT, MAT_HDF, matlab_tables
from nptcs.ingest.reading.native.sheet_cells import SheetSource
from nptcs.ingest.reading.native.tables import NativeTable, as_table, refuse_larger_table

TDMS = b"TDSm"
_UNIT_PROPERTIES = ("unit_string", "NI_UnitDescription", "Unit", "unit")


def is_binary_table(raw: bytes) -> bool:
    """Tell whether this is TDMS or MAT content, whatever the suffix says."""
    return raw.startswith((TDMS, MAT, MAT_HDF))


def read_binary_table(
    path: Path, raw: bytes, missing: frozenset[str], limits: FileLimits
) -> list[SheetSource]:
    """Read the tables of a TDMS or MAT file, one source each.

    A TDMS group is a table; channels of another length are a separate table. Units come from the
    channels' properties, and a time from their ``wf_increment`` where no channel contains one.
    For MAT files see `nptcs.ingest.reading.native.matlab.matlab_tables`.

    Raises
    ------
    InputError
        If it is damaged or larger than the limits.
    """
    try:
        read = _tdms if raw.startswith(TDMS) else matlab_tables
        tables = list(read(path, raw, limits))
    except InputError:
        raise
    except Exception as error:  # a damaged file: the libraries may raise anything
        raise InputError(
            f"cannot be read: {type(error).__name__}: {error}", "export it again", path
        ) from error
    if not tables:
        raise InputError("cannot be read: it holds no columns of numbers", "export it again", path)
    return [SheetSource(path, name, rows, missing) for name, rows in tables]


def _tdms(path: Path, raw: bytes, limits: FileLimits) -> Iterable[NativeTable]:
    from nptdms import TdmsFile

    with TdmsFile.open(io.BytesIO(raw)) as file:
        for group in file.groups():
            channels = [channel for channel in group.channels() if len(channel)]
            numeric = [channel for channel in channels if channel.dtype.kind in "iuf"]
            for length in dict.fromkeys(len(channel) for channel in numeric):
                same = [channel for channel in numeric if len(channel) == length]
                refuse_larger_table(path, length, len(same), limits)
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
                yield as_table(group.name, columns)
