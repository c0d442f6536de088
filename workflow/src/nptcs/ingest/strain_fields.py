"""Strain fields of a camera, one file per frame, as one row per frame: the mean over a window."""

from __future__ import annotations

import hashlib
import re
from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np

from nptcs.arrays import Mask
from nptcs.config.materials.ingest import FileLimits
from nptcs.errors import InputError
from nptcs.ingest.folder import natural_key, raw_files
from nptcs.ingest.reading.profiles import FormatProfile
from nptcs.ingest.reading.raw_file import RawFile, read_raw

FEWEST_FRAMES = 5
MEANS = ("strain_xx", "strain_yy", "strain", "strain_transverse")


def read_strain_fields(
    folder: Path,
    profiles: Mapping[str, FormatProfile],
    declared: FormatProfile | None,
    limits: FileLimits,
) -> RawFile:
    """Read every file of a folder as one frame and take the mean of its strains.

    The number of a frame is the last number in its file's name that differs between the files.
    The mean is taken over the points inside the profile's ``window``; a point without a strain
    does not count.

    Returns
    -------
    RawFile
        ``frame`` and the mean strains, one row per frame, in the order of the frames.

    Raises
    ------
    InputError
        If there are too few frames, two with the same number, or a frame has no point in the
        window.
    """
    paths = sorted(raw_files(folder).values(), key=lambda path: natural_key(path.name))
    if len(paths) < FEWEST_FRAMES:
        raise InputError(f"holds {len(paths)} frames", "export one file per frame", folder)
    frames = [
        read_raw(path, profiles, declared=declared, role="strain", limits=limits) for path in paths
    ]
    first = frames[0]
    numbers = _numbers_of(paths, folder)
    if len(set(numbers)) < len(numbers):
        raise InputError("two files have the same frame number", "remove one of them", folder)
    names = [name for name in MEANS if all(name in frame.values for frame in frames)]
    masks = [_inside(frame, folder) for frame in frames]
    values = {"frame": np.array(numbers, dtype=float)}
    for name in names:
        values[name] = np.array(
            [_mean(frame, name, mask) for frame, mask in zip(frames, masks, strict=True)]
        )
    digest = hashlib.sha256("".join(frame.sha256 for frame in frames).encode()).hexdigest()
    points = [int(mask.sum()) for mask in masks]
    window = first.profile.window or "all points"
    note = f"mean over {window} of {len(frames)} frames, {min(points)} to {max(points)} points each"
    return RawFile(
        folder,
        first.profile,
        first.detected,
        digest,
        values,
        {"frame": "number in the file's name"} | {name: first.columns[name] for name in names},
        {"frame": ""} | {name: first.units[name] for name in names},
        strain_source=first.strain_source,
        encoding=first.encoding,
        delimiter=first.delimiter,
        decimal=first.decimal,
        header_line=first.header_line,
        first_line=first.first_line,
        assumed=first.assumed,
        notes=(note, *first.notes),
    )


def _numbers_of(paths: Sequence[Path], folder: Path) -> list[int]:
    """Return the number of each frame: the last of the numbers in the names that is not constant.

    VIC's ``name-0012_0.csv`` counts its cameras after the frame. If the names contain different
    counts of numbers, the last number of each is taken.
    """
    found = [[int(number) for number in re.findall(r"\d+", path.stem)] for path in paths]
    if any(not numbers for numbers in found):
        raise InputError("no frame number in the names", "name the files by frame", folder)
    if len({len(numbers) for numbers in found}) > 1:
        return [numbers[-1] for numbers in found]
    places = list(zip(*found, strict=True))
    varying = [place for place in places if len(set(place)) == len(paths)]
    return list(varying[-1] if varying else places[-1])


def _inside(frame: RawFile, folder: Path) -> Mask:
    inside = np.ones(frame.rows, dtype=bool)
    for axis, (low, high) in frame.profile.window.items():
        if axis not in frame.values:
            raise InputError(
                f"the window needs the coordinate {axis}", "name its column in the profile",
                frame.path,
            )  # fmt: skip
        inside &= (frame.values[axis] >= low) & (frame.values[axis] <= high)
    if not inside.any():
        raise InputError(
            "no point lies in the window", "correct the profile's window", frame.path,
            value=frame.profile.window,
        )  # fmt: skip
    return inside


def _mean(frame: RawFile, name: str, inside: Mask) -> float:
    readings = frame.values[name][inside]
    readings = readings[~np.isnan(readings)]
    return float(readings.mean()) if len(readings) else float("nan")
