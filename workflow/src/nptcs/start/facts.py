"""Facts for the rules: found once, then read from a file until what they depend on changes."""

from __future__ import annotations

import atexit
import hashlib
import json
import sys
from collections.abc import Callable, Iterable, Mapping, Sequence
from contextlib import suppress
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

from nptcs.errors import InputError
from nptcs.files import read_sealed, write_sealed
from nptcs.provenance import code_hash

KIND = "StartFacts"
PACKAGE = Path(__file__).parents[1]


@dataclass(frozen=True)
class SolverFacts:
    """What the rules need to know of a solver with its options, as plain values."""

    module: str
    about: str
    needs_ply: bool
    loads_tyre: bool
    solves_tables: bool
    choices: dict[str, str]
    table_paths: dict[str, str]
    without_effect: tuple[str, ...]
    cores: int
    tokens: int
    case_s: float
    case_memory_mb: float
    timeout_s: float
    whole_plates: bool = False
    preload: tuple[str, ...] = ()

    def tables(self) -> dict[str, str]:
        """Name the files that the solver reads, as `SolverOptions.tables`."""
        return self.table_paths

    def cores_per_case(self) -> int:
        """Return the cores of one case, as `SolverOptions.cores_per_case`."""
        return self.cores

    def tokens_per_case(self) -> int:
        """Return the licence tokens of one case, as `SolverOptions.tokens_per_case`."""
        return self.tokens


@dataclass
class RuleFacts:
    """What the rules know.

    Parameters
    ----------
    solvers : dict of str to dict of str to SolverFacts
        By study and name.
    modules : dict of str to str
        Module of each solver of the package.
    plies, rubbers : tuple of str
        Materials that get a card.
    ply : dict of str to str
        The ply of each study that takes one.
    profiles : dict of str to str
        Hash of what each format profile says.
    tables : tuple of str
        Names of all result tables.
    files : dict of str to str
        Hash of each file that was examined; if its content changes, the facts are found again.
    code : dict of str to str
        Hashes of code that were requested.
    """

    solvers: dict[str, dict[str, SolverFacts]]
    modules: dict[str, str]
    plies: tuple[str, ...]
    rubbers: tuple[str, ...]
    ply: dict[str, str]
    profiles: dict[str, str]
    tables: tuple[str, ...]
    files: dict[str, str] = field(default_factory=dict)
    code: dict[str, str] = field(default_factory=dict)

    def code_of(self, *modules: str, words: bool = False) -> str:
        """Hash code as `nptcs.provenance.code_hash`, once for all starts with the same code."""
        name = json.dumps([modules, words])
        if name not in self.code:
            self.code[name] = code_hash(*modules, words=words)
        return self.code[name]


def known_facts(
    file: str | Path,
    given: Mapping[str, Any],
    inputs: Sequence[str | Path],
    find: Callable[[], RuleFacts],
) -> RuleFacts:
    """Read the facts from a file if what they depend on is unchanged, or find and keep them.

    Parameters
    ----------
    file : str or Path
        Where they are kept; written when Python ends. An edited file is ignored.
    given : mapping
        Plain values that they depend on: the configuration.
    inputs : sequence of str or Path
        Files that they depend on; the code of the package is added.
    find : callable
        Finds them; it raises `InputError` where a run must not begin.
    """
    key, code_key = keys_of(given, inputs)
    facts = _read(file, key)
    new = facts is None
    if facts is None:
        facts = find()
        facts.code = _read_code(file, code_key)
    hashes = len(facts.code)

    def keep() -> None:
        if new or len(facts.code) > hashes:
            with suppress(OSError):
                content = {"key": key, "code_key": code_key, "facts": asdict(facts)}
                write_sealed(file, json.loads(json.dumps(content)), KIND)

    atexit.register(keep)
    return facts


def keys_of(given: Mapping[str, Any], inputs: Sequence[str | Path]) -> tuple[str, str]:
    """Hash everything that facts depend on, and what hashes of code depend on.

    The facts depend on the values, the files, this package and the version of Python. The hashes
    of code depend on the Python files among them and on that version only, so a change of the
    configuration leaves them as they are.
    """
    read = contents([*map(str, inputs), *map(str, PACKAGE.rglob("*.py"))])
    code = {file: content for file, content in read.items() if file.endswith(".py")}
    return _hash([sys.version, given, read]), _hash([sys.version, code])


def _hash(content: Sequence[Any]) -> str:
    text = json.dumps(content, sort_keys=True, default=str)
    return hashlib.sha256(text.encode()).hexdigest()


def contents(paths: Iterable[str]) -> dict[str, str]:
    """Hash files; one that cannot be read is ``missing``."""
    found = {}
    for path in paths:
        try:
            found[path] = hashlib.sha256(Path(path).read_bytes()).hexdigest()
        except OSError:
            found[path] = "missing"
    return found


def _read(file: str | Path, key: str) -> RuleFacts | None:
    try:
        content = read_sealed(file, KIND)
        if content["key"] != key:
            return None
        facts = content["facts"]
        solvers = {
            study: {name: SolverFacts(**one) for name, one in of_study.items()}
            for study, of_study in facts.pop("solvers").items()
        }
        found = RuleFacts(solvers=solvers, **facts)
        return found if contents(found.files) == found.files else None
    except (OSError, InputError, KeyError, TypeError):
        return None


def _read_code(file: str | Path, code_key: str) -> dict[str, str]:
    """Read hashes of code that other facts were kept with, if the code is the same."""
    try:
        content = read_sealed(file, KIND)
        return dict(content["facts"]["code"]) if content["code_key"] == code_key else {}
    except (OSError, InputError, KeyError, TypeError):
        return {}
