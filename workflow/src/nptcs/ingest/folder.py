"""A laboratory's folder: which files it contains, and where to find a named one."""

from __future__ import annotations

import difflib
import unicodedata
from pathlib import Path

from nptcs.errors import InputError

NOTES = ("readme", "readme.md", "readme.txt")
"""Names, in any case, of files that are notes to the reader, not test data."""

HIDDEN = (".", "~$")
"""Beginnings of names of files that contain no data."""


def raw_files(folder: Path) -> dict[str, Path]:
    """All files below a folder, by relative name in natural order.

    Hidden files are left out, those by which an office program locks a document (``~$a.xlsx``),
    and links that lead out of the folder.
    """
    found = {
        path.relative_to(folder).as_posix(): path
        for path in folder.rglob("*")
        if path.is_file()
        and not any(part.startswith(HIDDEN) for part in path.relative_to(folder).parts)
        and _stays_inside(path, folder)
    }
    return dict(sorted(found.items(), key=lambda item: natural_key(item[0])))


def _stays_inside(path: Path, folder: Path) -> bool:
    """Tell whether a file is in the folder itself, not behind a link out of it."""
    return path.resolve().is_relative_to(folder.resolve())


def is_note(name: str) -> bool:
    """Tell whether a file of the folder is a README, by its relative name."""
    return name.rsplit("/", 1)[-1].casefold() in NOTES


def natural_key(name: str) -> tuple[tuple[int, int, str], ...]:
    """Sort key by which 2 comes before 11."""
    parts: list[tuple[int, int, str]] = []
    digits = ""
    for mark in name.casefold() + " ":
        if mark.isascii() and mark.isdigit():
            digits += mark
            continue
        if digits:
            parts.append((0, int(digits), ""))
            digits = ""
        parts.append((1, 0, mark))
    return tuple(parts)


def is_there(folder: Path, name: str) -> bool:
    """Tell whether a file, or a folder of frames, that the sheet names can be found."""
    try:
        return find_file(folder, name).exists()
    except InputError:
        return False


def find_file(folder: Path, name: str) -> Path:
    """Find a file that the sheet names, even if its accents are stored another way.

    Raises
    ------
    InputError
        If it is missing; with the most similar name.
    """
    if (folder / name).exists():
        return folder / name
    wanted = unicodedata.normalize("NFC", name)
    present = raw_files(folder)
    for other, path in present.items():
        if unicodedata.normalize("NFC", other) == wanted:
            return path
    near = difflib.get_close_matches(name, present, n=1)
    hint = f"; did you mean '{near[0]}'?" if near else ""
    raise InputError(f"file is missing{hint}", "correct the name in the sheet", folder / name)
