"""A finished run, read as it is on disk, even if another version of the package made it."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, get_args

import pandas as pd
from pandas.errors import EmptyDataError, ParserError

from nptcs.errors import InputError
from nptcs.files import read_model, sha256_of_file
from nptcs.language import ENGLISH, Language, tr, translatable
from nptcs.runs.content import CARD, FILES, laboratory_files
from nptcs.runs.identity import RunIdentity, hash_of_table
from nptcs.tables.catalogue import result_files
from nptcs.tables.laboratory.material_card import MaterialCard
from nptcs.tables.result_table import Heading
from nptcs.yaml_files import read_yaml

IDENTITY = "identity.json"
CONFIGURATION = "configuration.yaml"
NO_SOFTWARE = translatable(
    "there is no record of its software, which older versions of nptcs did not keep"
)


@dataclass(frozen=True)
class FinishedRun:
    """What is known of a run.

    Parameters
    ----------
    name : str
        How the user named it.
    configuration : mapping
        Plain values, as the run's version knew them.
    card : MaterialCard
    tables : mapping of str to DataFrame
        Result tables by file name; columns that a contract declares as text are read as text.
    inputs : mapping of str to str
        SHA-256 of each input file.
    software : mapping of str to str
        Versions; empty if the run has no record of them.
    identity : RunIdentity, optional
        None for a run of a version that did not write one.
    """

    name: str
    configuration: Mapping[str, Any]
    card: MaterialCard
    tables: Mapping[str, pd.DataFrame]
    inputs: Mapping[str, str]
    software: Mapping[str, str] = field(default_factory=dict)
    identity: RunIdentity | None = None

    @property
    def studies(self) -> dict[str, dict[str, Any]]:
        """The studies of the configuration by name."""
        return {str(one["name"]): one for one in self.configuration.get("studies", [])}

    @property
    def factors(self) -> dict[str, Heading]:
        """Label and unit of each factor; the first study's label counts."""
        found: dict[str, Heading] = {}
        for study in self.studies.values():
            for one in study.get("factors", []):
                unit = "°" if one.get("unit") == "deg" else str(one.get("unit", ""))
                found.setdefault(str(one["name"]), Heading(str(one.get("label", "")), unit))
        return {name: label for name, label in found.items() if label.name}

    @property
    def language(self) -> Language:
        """Language of the run's own report; English if the run names no known language."""
        named = (self.configuration.get("laboratory") or {}).get("language")
        return next((one for one in get_args(Language) if one == named), ENGLISH)

    def table(self, file: str) -> pd.DataFrame | None:
        """Return a table by its file name; None if the run has no table of this name."""
        return self.tables.get(file)

    def what(self) -> str:
        """Say in a few words which run this is."""
        if self.identity is None:
            return tr(
                "{name}: a run without identity, as left by older versions of nptcs",
                name=self.name,
            )
        return tr(
            "{name}: run {identity}, {date}",
            name=self.name,
            identity=self.identity.short,
            date=self.identity.made_text,
        )


def read_run(folder: Path, name: str, software: Mapping[str, str] | None = None) -> FinishedRun:
    """Read a finished run.

    Parameters
    ----------
    folder : Path
        A project folder with ``results`` in it, or a folder of results.
    name : str
        How the user named it.
    software : mapping of str to str, optional
        Versions that are known from elsewhere, such as an archive's description.

    Raises
    ------
    InputError
        For a folder without a finished run, and for a file that was changed after the run.
    """
    results = folder / "results" if (folder / "results").is_dir() else folder
    _refuse_unfinished(results, name)
    identity = _identity(results)
    if identity is not None:
        _refuse_edited(results, identity)
    configuration = _configuration(results / CONFIGURATION)
    tables = _tables(results / "tables", configuration)
    return FinishedRun(
        name=name,
        configuration=configuration,
        card=read_model(results / CARD, MaterialCard),
        tables=tables,
        inputs=identity.inputs if identity else _known_inputs(tables, configuration, folder),
        software=identity.software if identity else software or {},
        identity=identity,
    )


def _refuse_unfinished(results: Path, name: str) -> None:
    for needed in (CONFIGURATION, CARD, f"tables/{FILES}", "tables/cases.csv"):
        if not (results / needed).is_file():
            raise InputError(
                "there is no finished run here",
                "name a project folder with a finished run, its folder of results, or a file made "
                "by 'nptcs archive'",
                results / needed,
                value=name,
            )


def _identity(results: Path) -> RunIdentity | None:
    path = results / IDENTITY
    return read_model(path, RunIdentity) if path.is_file() else None


def _refuse_edited(results: Path, identity: RunIdentity) -> None:
    """Compare tables and card with what the run wrote."""
    for file, written in identity.tables.items():
        path = results / file if file == CARD else results / "tables" / file
        if not path.is_file():
            raise InputError("this result of the run is missing", _RESTORE, path)
        found = sha256_of_file(path) if file == CARD else hash_of_table(path)
        if found != written:
            raise InputError(
                "this result was changed after the run had written it: it was edited, or another "
                "run has begun to write here",
                _RESTORE,
                path,
            )


_RESTORE = "run snakemake to completion, or unpack the archive of the run again"


def _configuration(path: Path) -> dict[str, Any]:
    values = read_yaml(path)
    if not isinstance(values, dict):
        raise InputError("is not a configuration", "run snakemake again", path)
    return dict(json.loads(json.dumps(values, default=str)))


def _tables(folder: Path, configuration: Mapping[str, Any]) -> dict[str, pd.DataFrame]:
    studies = [str(one["name"]) for one in configuration.get("studies", []) if one.get("terms")]
    contracts = {file: row.contract for file, row, _ in result_files(studies)}
    found = {}
    for path in sorted(folder.glob("*.csv")):
        contract = contracts.get(path.name)
        columns = contract.to_schema().columns if contract else {}
        text = {
            name: str
            for name, column in columns.items()
            if str(column.dtype).startswith(("str", "object"))
        }
        found[path.name] = _read(path, text)
    return found


def _read(path: Path, text: Mapping[str, type[str]]) -> pd.DataFrame:
    try:
        return pd.read_csv(path, dtype=dict(text), keep_default_na=False, na_values=[""])
    except (EmptyDataError, ParserError, UnicodeDecodeError, ValueError) as error:
        raise InputError(f"is not a CSV table: {error}", _RESTORE, path) from None


def _known_inputs(
    tables: Mapping[str, pd.DataFrame], configuration: Mapping[str, Any], folder: Path
) -> dict[str, str]:
    """Return what is known of the inputs of a run without identity."""
    sheet = Path(str(configuration.get("lab_data", {}).get("specimen_sheet", "")))
    found = laboratory_files(tables[FILES].fillna(""), sheet.parent.as_posix())
    for text in _texts(configuration):
        if (folder / text).is_file():
            found[text] = sha256_of_file(folder / text)
    return dict(sorted(found.items()))


def _texts(value: object) -> list[str]:
    """Return all texts of plain values that may name a file."""
    if isinstance(value, dict):
        return [text for part in value.values() for text in _texts(part)]
    if isinstance(value, list):
        return [text for part in value for text in _texts(part)]
    return [value] if isinstance(value, str) and "." in value and "\n" not in value else []
