"""Two runs' configurations key by key, and the software that they used."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from typing import Any

from nptcs.language import tr
from nptcs.runs.finished import NO_SOFTWARE, FinishedRun
from nptcs.runs.part import RESULT, Found, Part, part_table, presence


def compare_configuration(a: FinishedRun, b: FinishedRun) -> Part:
    """Compare the configurations of two runs, one row per key."""
    one, two = dict(flattened(a.configuration)), dict(flattened(b.configuration))
    return Part(
        "configuration",
        tr("Configuration"),
        tr("The whole configuration with all defaults, key by key; lists of named things by name."),
        part_table(_rows("key", one, two), ["key", "a", "b"]),
    )


def compare_software(a: FinishedRun, b: FinishedRun) -> Part:
    """Compare the versions of the software of two runs, and the code that made the tables."""
    sides: list[dict[str, str]] = []
    remarks = []
    for letter, run in (("A", a), ("B", b)):
        versions = dict(run.software)
        if run.identity is not None:
            versions[tr("code that made the tables")] = run.identity.code
        if not versions:
            remarks.append(tr("run {run}: {why}", run=letter, why=tr(NO_SOFTWARE)))
        sides.append(versions)
    return Part(
        "software",
        tr("Software"),
        tr(
            "Versions when the tables were complete; the code is a hash of what it does, without "
            "comments and messages."
        ),
        part_table(_rows("software", *sides), ["software", "a", "b"]),
        tuple(remarks),
    )


def _rows(name: str, one: Mapping[str, str], two: Mapping[str, str]) -> list[dict[str, object]]:
    rows: list[dict[str, object]] = []
    for key in dict.fromkeys([*one, *two]):
        found = presence(key in one, key in two)
        if found is None:
            found = Found.SAME if one[key] == two[key] else Found.DIFFERENT
        rows.append({name: key, "a": one.get(key, ""), "b": two.get(key, ""), RESULT: found})
    return rows


def flattened(value: Any, path: str = "") -> Iterator[tuple[str, str]]:
    """Go through plain values as pairs of a key and a text.

    Items of a list that all have a name are told apart by it; others are compared as a whole.

    Examples
    --------
    >>> dict(flattened({"a": {"b": 1}, "studies": [{"name": "x", "load_n": 5}]}))
    {'a.b': '1', 'studies[x].load_n': '5', 'studies': '["x"]'}
    """
    if isinstance(value, Mapping) and value:
        for key, part in value.items():
            yield from flattened(part, f"{path}.{key}" if path else str(key))
    elif _named(value):
        names = [str(item["name"]) for item in value]
        for name, item in zip(names, value, strict=True):
            rest = {key: part for key, part in item.items() if key != "name"}
            yield from flattened(rest, f"{path}[{name}]")
        yield path, json.dumps(names, ensure_ascii=False)
    else:
        yield path, json.dumps(value, ensure_ascii=False, sort_keys=True)


def _named(value: Any) -> bool:
    """Tell whether a value is a list of things that each have a different name."""
    if not isinstance(value, list) or not value:
        return False
    names = [item.get("name") if isinstance(item, Mapping) else None for item in value]
    return None not in names and len(set(map(str, names))) == len(names)
