"""The identity of a run: one hash of everything that decides its numbers, and of the numbers."""

from __future__ import annotations

import csv
import hashlib
import json
from collections.abc import Iterable, Mapping
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

from pydantic import Field

from nptcs.config.base import Strict
from nptcs.files import sha256_of_text
from nptcs.tables.run_columns import TIMES

WORDS_ONLY = ("laboratory", "report")
"""Sections of the configuration that decide how a run is shown, and none of its numbers."""

SHORT = 12
"""Digits by which a person names a run."""


class RunIdentity(Strict):
    """What a run is, by content; `made` and `software` are recorded, but are not part of it."""

    identity: str = Field(description="SHA-256 over inputs, configuration, code and tables")
    inputs: dict[str, str] = Field(description="SHA-256 of each input file")
    configuration: str = Field(
        description="SHA-256 of the configuration, defaults included, without what is only shown"
    )
    code: str = Field(description="Hash of the code that made the tables")
    tables: dict[str, str] = Field(
        description="Hash of each table and of the material card, columns with times left out"
    )
    software: dict[str, str] = Field(
        default_factory=dict, description="Versions in use when the tables were complete"
    )
    made: datetime = Field(description="When the tables were complete, UTC")

    @property
    def short(self) -> str:
        """The first digits, by which a person names the run."""
        return self.identity[:SHORT]

    @property
    def made_text(self) -> str:
        """Write the time of the run for a reader, ``2026-11-26 04:03 UTC``."""
        return self.made.astimezone(UTC).strftime("%Y-%m-%d %H:%M UTC")


def identify(
    inputs: Mapping[str, str],
    configuration: Mapping[str, Any],
    code: str,
    tables: Mapping[str, str],
    software: Mapping[str, str],
    made: datetime,
) -> RunIdentity:
    """Identify a run by its content.

    Parameters
    ----------
    inputs : mapping of str to str
        SHA-256 of each input file by its name.
    configuration : mapping
        The whole configuration, plain values; `WORDS_ONLY` is left out of the identity.
    code : str
        Hash of the code that made the tables.
    tables : mapping of str to str
        `hash_of_table` of each result table, and the hash of the material card.
    software : mapping of str to str
        Versions; they are recorded, but are not part of the identity.
    made : datetime
        When the tables were complete; not part of the identity either.

    Returns
    -------
    RunIdentity

    Examples
    --------
    >>> from datetime import UTC, datetime
    >>> one = identify({}, {"a": 1}, "c0de", {}, {}, datetime(2026, 1, 1, tzinfo=UTC))
    >>> later = identify({}, {"a": 1}, "c0de", {}, {}, datetime(2027, 1, 1, tzinfo=UTC))
    >>> other = identify({}, {"a": 2}, "c0de", {}, {}, datetime(2026, 1, 1, tzinfo=UTC))
    >>> one.identity == later.identity, one.identity == other.identity
    (True, False)
    """
    deciding = {key: value for key, value in configuration.items() if key not in WORDS_ONLY}
    settings = sha256_of_text(json.dumps(deciding, sort_keys=True, ensure_ascii=False))
    parts = {
        "inputs": dict(inputs),
        "configuration": settings,
        "code": code,
        "tables": dict(tables),
    }
    text = json.dumps(parts, sort_keys=True, ensure_ascii=False)
    moment = made.astimezone(UTC).replace(microsecond=0)
    return RunIdentity(identity=sha256_of_text(text), software=dict(software), made=moment, **parts)


def hash_of_table(path: str | Path) -> str:
    """Hash the content of a CSV table, its columns with times left out.

    A repeated run takes a different time for each case; its numbers are the same.
    """
    digest = hashlib.sha256()
    with Path(path).open(encoding="utf-8", newline="") as stream:
        rows = csv.reader(stream)
        kept: list[int] | None = None
        for row in rows:
            if kept is None:
                kept = [place for place, name in enumerate(row) if name not in TIMES]
            cells = [row[place] if place < len(row) else "" for place in kept]
            digest.update((json.dumps(cells, ensure_ascii=False) + "\n").encode())
    return digest.hexdigest()


def hashes_of_tables(paths: Iterable[str | Path]) -> dict[str, str]:
    """Hash tables by their file names."""
    return {Path(path).name: hash_of_table(path) for path in paths}
