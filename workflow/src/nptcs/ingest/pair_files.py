"""Which files belong to one specimen: by the words and numbers of their names, never by order."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from pathlib import PurePosixPath

from nptcs.ingest.dimension_tables import Dimensions
from nptcs.ingest.file_names import specimen_id, tokens
from nptcs.ingest.runs_of_pieces import piece_of

NO_MACHINE = "strains without a force file of the same specimen"
"""Reason for a strain file that no machine file belongs to."""


def pair_cameras(rows: Sequence[dict[str, str]], strains: Sequence[str]) -> dict[str, str]:
    """Give each strain file to the one machine file of the same specimen.

    Parameters
    ----------
    rows : sequence of dict
        Rows of the sheet, one per force file; get ``strain_file``.
    strains : sequence of str
        Strain files, or folders of frames.

    Returns
    -------
    dict of str to str
        Strain files that fit none or several, with the reason.
    """
    machines = {number: tokens(row["force_file"]) for number, row in enumerate(rows)}
    chosen: dict[str, int] = {}
    left = _numbered_apart(machines, strains)
    for name in (name for name in strains if name not in left):
        own = tokens(name)
        equal = [number for number, words in machines.items() if words == own]
        near = equal or [number for number, words in machines.items() if _says_the_same(words, own)]
        if len(near) == 1:
            chosen[name] = near[0]
        else:
            files = ", ".join(rows[number]["force_file"] for number in near[:3])
            left[name] = f"strains that fit {len(near)} force files by name: {files}"
            if not near:
                left[name] = NO_MACHINE
    for name, number in chosen.items():
        rivals = [other for other, place in chosen.items() if place == number]
        if len(rivals) == 1:
            rows[number]["strain_file"] = name
        else:
            left[name] = f"one of {len(rivals)} strain files of the same specimen"
    return left


def _numbered_apart(machines: Mapping[int, Counter[str]], strains: Sequence[str]) -> dict[str, str]:
    """Find cameras' files that are numbered from 0 where the machine's are from 1, or the reverse.

    Their names would pair all of them except the first or last with the wrong specimen.
    """
    series: dict[frozenset[str], tuple[set[int], dict[int, str]]] = {}
    for words in machines.values():
        key, number = _series_and_number(words)
        series.setdefault(key, (set(), {}))[0].update(number)
    for name in strains:
        key, number = _series_and_number(tokens(name))
        if key in series:
            series[key][1].update(dict.fromkeys(number, name))
    left: dict[str, str] = {}
    for numbers, named in series.values():
        shifted = any({number + step for number in named} == numbers for step in (1, -1))
        if len(named) > 1 and shifted:
            why = "camera and machine files do not start at the same number: pair them by hand"
            left |= dict.fromkeys(named.values(), why)
    return left


def _series_and_number(words: Counter[str]) -> tuple[frozenset[str], list[int]]:
    """Words of a name, and its number if it has a single one."""
    numbers = [int(word) for word, count in words.items() if word.isdecimal() for _ in range(count)]
    own = frozenset(word for word in words if not word.isdecimal())
    return own, numbers if len(numbers) == 1 else []


def _says_the_same(words: Counter[str], others: Counter[str]) -> bool:
    """Tell whether two names agree: equal numbers, and the words of one among the other's."""
    numbers = Counter({w: n for w, n in words.items() if w.isdigit()})
    if numbers != Counter({w: n for w, n in others.items() if w.isdigit()}) or not numbers:
        return False
    return words <= others or others <= words


def add_dimensions(rows: Sequence[dict[str, str]], dimensions: Sequence[Dimensions]) -> None:
    """Fill in the dimensions whose row names one test, and is named by no other row."""
    for row in rows:
        path = PurePosixPath(row["force_file"])
        piece = piece_of(specimen_id(path.name))
        file = str(path.with_name(piece + ".x")) if piece else row["force_file"]
        words = tokens(file) + tokens(row["force_part"] + ".x")
        fitting = [one for one in dimensions if one.words and one.words <= words]
        most = max((sum(one.words.values()) for one in fitting), default=0)
        fitting = [one for one in fitting if sum(one.words.values()) == most]
        if len(fitting) != 1:
            continue
        row |= fitting[0].cells
        note = f"dimensions from {fitting[0].file}"
        row["remarks"] = "; ".join(text for text in (row["remarks"], note, fitting[0].note) if text)
