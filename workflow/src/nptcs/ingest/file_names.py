"""What the names of files and folders tell: role, number, test, material, fibre angle."""

from __future__ import annotations

import re
import unicodedata
from collections import Counter
from collections.abc import Iterable, Mapping
from pathlib import PurePosixPath

from nptcs.ingest.conditioning.declared_test import loadings_in_name, loadings_named
from nptcs.ingest.runs_of_pieces import piece_of
from nptcs.tables.laboratory.specimens import TestType

ROLE_WORDS = frozenset(
    [
        "vic",
        "vic2d",
        "vic3d",
        "dic",
        "aramis",
        "gom",
        "zeiss",
        "ncorr",
        "opencorr",
        "dice",
        "frame",
        "frames",
        "image",
        "images",
        "camera",
        "cameras",
        "kamera",
        "cam",
        "optical",
        "strain",
        "strains",
        "dehnung",
        "deformation",
        "force",
        "forces",
        "load",
        "loads",
        "kraft",
        "wdw",
        "mts",
        "instron",
        "bluehill",
        "zwick",
        "testxpert",
        "shimadzu",
        "trapezium",
        "tinius",
        "olsen",
        "machine",
        "maschine",
        "utm",
        "raw",
        "rawdata",
        "data",
        "daten",
        "donnees",
        "extensometer",
        "export",
        "exports",
        "csv",
        "txt",
        "curve",
        "curves",
        "kurve",
        "csvs",
        "file",
        "files",
        "measurement",
        "measurements",
        "messung",
        "messungen",
    ]
)
"""Words that say which device or which kind of file it is, not which specimen."""
_DATE = re.compile(
    r"(?<!\d)(?:(?:19|20)\d\d([-_.]?)(?:0[1-9]|1[0-2])\1(?:0[1-9]|[12]\d|3[01])"
    r"|(?:0?[1-9]|[12]\d|3[01])([-_.])(?:0?[1-9]|1[0-2])\2(?:19|20)\d\d)"
    r"(?:[-_t ]\d{4}(?:\d\d)?)?(?!\d)"
)
"""Day (and time) of a measurement: machine and camera may have been exported on different days."""
_LAST_NUMBER = re.compile(r"[ _.-]*\d+(?=\D*$)")
_ROLE_TAIL = re.compile(
    r"(?i)(?:^|[ _.-]+)(?:" + "|".join(sorted(ROLE_WORDS, key=len, reverse=True)) + r"|vic-[23]d)$"
)
_ROLE_HEAD = re.compile(
    r"(?i)^(?:" + "|".join(sorted(ROLE_WORDS, key=len, reverse=True)) + r"|vic-[23]d)[ _.-]+"
)
_RUBBER = re.compile(
    r"(?i)rubber|gummi|caoutchouc|goma|silicon|elastomer|ecoflex|dragon.?skin|\bNBR\b|\bEPDM\b"
    r"|\bTPU\b|shore|(?<![a-z0-9])[2-9]\d ?a(?![a-z0-9])"
)
_SHEAR = re.compile(r"(?i)shear|schub|cisaillement|\bIPS\b|(?:±|\+-|\+/-|pm) ?45")
_MATERIALS = {
    "cfrp": r"cfrp|cfk|carbon|\bcf\b",
    "gfrp": r"gfrp|gfk|glass|glas\b|\bgf\b",
    "afrp": r"aramid|kevlar|afrp",
    "flax": r"\bflax|\blin\b|flachs",
    "steel": r"steel|stahl|acier",
    "aluminium": r"alumini?um|\balu\b",
    "epoxy": r"epoxy|epoxid",
}
_ANGLE = re.compile(
    r"(?i)(?:±|\+-|\+/-)? ?(?<![\d.])(0|10|30|45|60|90) ?(?:°|deg|grad)"
    r"|(?:^|[/_ -])[tc](0|45|90)(?=[/_ .-])"
)


def tokens(name: str) -> Counter[str]:
    """Words and numbers of a path without suffix, dates and role words: ``UD_01`` is ``ud``, ``1``.

    Returns
    -------
    Counter
        How often each occurs in the folders and the file's name together.
    """
    text = unicodedata.normalize("NFKC", str(PurePosixPath(name).with_suffix(""))).casefold()
    undated = _DATE.sub(" ", text)
    text = undated if any(mark.isdigit() for mark in undated) else text
    parts = re.findall(r"[^\W\d_]+\d[dD](?![^\W_])|[^\W\d_]+|\d+", text)
    kept = (part.lstrip("0") or "0" if part.isdigit() else part for part in parts)
    return Counter(part for part in kept if part not in ROLE_WORDS)


def specimen_id(name: str) -> str:
    """Specimen id from a file name: without folder, suffix and role words at its ends."""
    stem = re.sub(r"\.[A-Za-z]\w{0,5}$", "", PurePosixPath(name).name)
    while _ROLE_TAIL.search(stem):
        stem = _ROLE_TAIL.sub("", stem)
    while _ROLE_HEAD.search(stem):
        stem = _ROLE_HEAD.sub("", stem)
    return _safe(stem) or "specimen"


def _safe(text: str) -> str:
    plain = unicodedata.normalize("NFKD", text)
    plain = "".join(mark for mark in plain if not unicodedata.combining(mark))
    return re.sub(r"[^A-Za-z0-9._-]+", "_", plain).strip("_.-")


def unique_ids(names: Mapping[int, tuple[str, str]]) -> dict[int, str]:
    """Give each row a unique id, ignoring case: by its folders, then by a number.

    Parameters
    ----------
    names : mapping of int to (str, str)
        Row → id from its file's name, and the file's relative path.
    """
    ids = {row: own for row, (own, _) in names.items()}
    for depth in (1, 2, 3):
        for row in _doubles(ids):
            own, path = names[row]
            folders = [_safe(_folder_name(part)) for part in PurePosixPath(path).parent.parts]
            own = re.sub(r"(?i)^specimen(?:_rawdata)?[ _.-]*(?=\d|$)", "", own)
            ids[row] = "_".join(part for part in [*folders[-depth:], own] if part) or "specimen"
    seen: Counter[str] = Counter()
    for row, own in ids.items():
        seen[own.casefold()] += 1
        number = seen[own.casefold()]
        while number > 1 and f"{own}_{number}".casefold() in {*seen, *_folded(ids, row)}:
            number += 1
        ids[row] = own if number == 1 else f"{own}_{number}"
    return ids


def _folded(ids: Mapping[int, str], row: int) -> set[str]:
    return {own.casefold() for other, own in ids.items() if other != row}


def _doubles(ids: Mapping[int, str]) -> list[int]:
    count = Counter(own.casefold() for own in ids.values())
    return [row for row, own in ids.items() if count[own.casefold()] > 1]


def family(name: str) -> str:
    """Path without the number of the frame: what the files of a sequence share.

    VIC's ``name-0012_0.csv`` counts its cameras after the frame.
    """
    path = PurePosixPath(name)
    stem = re.sub(r"(?<=\d)_\d$", "", path.stem)
    return str(path.with_name(_LAST_NUMBER.sub("", stem) + "#" + path.suffix))


def series_names(files: Iterable[str]) -> dict[str, str]:
    """Name the series of each file: its name without number and role words.

    Files of equal names in different folders are different series, named with their folder.
    """
    files = list(files)
    own = {name: _series(name) for name in files}
    folders: dict[str, set[str]] = {}
    for series, folder in own.values():
        folders.setdefault(series, set()).add(folder)
    return {
        name: series if len(folders[series]) == 1 else f"{folder}/{series}"
        for name, (series, folder) in own.items()
    }


def _series(name: str) -> tuple[str, str]:
    """Name of a file's series, and the folder that contains the series.

    A name that says nothing but a number, a device or a run leaves the name to the folder: of
    one specimen (``T0-1/machine.csv``), of the runs of a piece (``S1/run2.csv``), or of a series.
    """
    path = PurePosixPath(name)
    piece = piece_of(specimen_id(name)) or path.stem
    stem = specimen_id(_LAST_NUMBER.sub("", _undated(piece)) + ".x")
    number = _SAYS_NOTHING.get(re.sub(r"[ _.-]*(?:rawdata)?$", "", stem.casefold()))
    if number is None or not path.parent.name:
        return stem, str(path.parent)
    number = r"(?!)" if "rawdata" in path.stem.casefold() or path.stem.isdigit() else number
    folder = _folder_name(path.parent.name)
    return _safe(re.sub(number, "", folder)) or _safe(folder), str(path.parent.parent)


_SAYS_NOTHING = {
    "": r"(?!)",
    "specimen": r"[ _.-]+\d+$",
    **dict.fromkeys(("run", "lauf", "pass"), r"[ _.-]*\d+$"),
}
"""Names that only their folder tells apart, and which part of the folder's name is a number."""
_OF_BLUEHILL = re.compile(r"\.is_\w+?_(?:RawData|Exports)$")


def _folder_name(folder: str) -> str:
    """Name of a folder without what Bluehill adds: ``UD1.is_tens_RawData`` is ``UD1``."""
    return _OF_BLUEHILL.sub("", folder)


def _undated(stem: str) -> str:
    """Take the date off a name, unless nothing else is left."""
    plain = _DATE.sub("", stem).strip("_.- ")
    return plain if any(mark.isalpha() for mark in plain) else stem


def proposed_test(path: str, texts: Iterable[str]) -> str:
    """Propose a test from the words of a path and of the file's head; empty if no word fits."""
    texts = list(texts)
    words = [path.replace("_", " "), *texts]
    known = {test.value for test in TestType}
    named = loadings_named(texts) | loadings_in_name(path)
    rubber = any(_RUBBER.search(text) for text in words)
    if len(named) == 1 and not rubber:
        loading = next(iter(named))
        if loading == "tension" and any(_SHEAR.search(text) for text in words):
            return "shear"
        return loading if loading in known else ""
    if any(_SHEAR.search(text) for text in words) and not rubber:
        return "shear"
    if rubber and named <= {"tension"}:
        return "rubber_tension"
    if rubber and named == {"compression"} and "rubber_compression" in known:
        return "rubber_compression"
    return ""


def proposed_material(path: str) -> str:
    """Propose a material from the words of a path; empty if no word fits."""
    words = path.replace("_", " ").replace("-", " ")
    for material, pattern in _MATERIALS.items():
        if re.search(f"(?i){pattern}", words):
            return material
    if not _RUBBER.search(words):
        return ""
    shore = re.search(r"(?i)(?<![a-z0-9])([2-9]\d) ?a(?![a-z0-9])", words)
    return f"rubber_{shore.group(1)}A" if shore else "rubber"


def proposed_angle(path: str) -> str:
    """Propose a fibre angle from the names; empty if they contain none."""
    found = _ANGLE.search(path)
    return next((group for group in found.groups() if group), "") if found else ""
