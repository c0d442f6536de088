"""Check an archive: every file as packed, nothing missing or added, tables and card valid."""

from __future__ import annotations

import hashlib
import json
import zipfile
from collections.abc import Iterator
from pathlib import Path, PurePosixPath

from nptcs.archive.crate import CONFIGURATION, ENVIRONMENT, MANIFEST, METADATA
from nptcs.config.root import Config, read_config
from nptcs.errors import InputError
from nptcs.files import read_model
from nptcs.runs.identity import RunIdentity
from nptcs.tables.catalogue import result_files
from nptcs.tables.io import read_table
from nptcs.tables.laboratory.material_card import MaterialCard
from nptcs.yaml_files import read_yaml


def unpack(archive: Path, folder: Path) -> None:
    """Unpack an archive into a new folder.

    Raises
    ------
    InputError
        If it is not a zip file, or a name in it leads out of the folder.
    """
    try:
        with zipfile.ZipFile(archive) as packed:
            for name in packed.namelist():
                path = PurePosixPath(name)
                if path.is_absolute() or ".." in path.parts or "\\" in name:
                    raise InputError(
                        "a name in it leads out of the folder", "do not use it", archive, value=name
                    )
            packed.extractall(folder)
    except (zipfile.BadZipFile, EOFError) as error:
        remedy = "copy it again from where it was written"
        raise InputError(f"is not a complete zip file: {error}", remedy, archive) from None


def faults_of(folder: Path) -> list[str]:
    """Return the faults of an unpacked archive, one line each; empty if there are none."""
    return packed_faults(folder) or list(_unsound_results(folder))


def packed_faults(folder: Path) -> list[str]:
    """Return what is not as it was packed, whichever version of the package packed it."""
    return list(_broken_files(folder)) or list(_metadata_faults(folder))


def run_identity(folder: Path) -> RunIdentity | None:
    """Return the identity of an archived run; None if its version did not write one."""
    path = folder / "results" / "identity.json"
    return read_model(path, RunIdentity) if path.is_file() else None


def packed_software(folder: Path) -> dict[str, str]:
    """Return the versions that an unpacked archive names."""
    facts = json.loads((folder / ENVIRONMENT).read_text(encoding="utf-8"))
    return {"Python": str(facts["python"]), **facts["packages"]}


def count_files(folder: Path) -> int:
    """Return how many files the manifest lists."""
    return len(_manifest(folder))


def _manifest(folder: Path) -> dict[str, str]:
    """Read the manifest: name → SHA-256."""
    path = folder / MANIFEST
    if not path.is_file():
        raise InputError("has no manifest, so it is not an archive of a study", file=path)
    pairs = (line.split("  ", 1) for line in path.read_text(encoding="utf-8").splitlines())
    return {pair[-1]: pair[0] for pair in pairs}


def _broken_files(folder: Path) -> Iterator[str]:
    """Compare the files with the manifest."""
    listed = _manifest(folder)
    held = {
        path.relative_to(folder).as_posix(): path for path in folder.rglob("*") if path.is_file()
    }
    held.pop(MANIFEST)
    yield from (f"{name}: is missing" for name in sorted(set(listed) - set(held)))
    yield from (f"{name}: was added" for name in sorted(set(held) - set(listed)))
    for name in sorted(set(listed) & set(held)):
        if hashlib.sha256(held[name].read_bytes()).hexdigest() != listed[name]:
            yield f"{name}: was changed"


def _metadata_faults(folder: Path) -> Iterator[str]:
    """Compare the RO-Crate's own description with the manifest."""
    graph = json.loads((folder / METADATA).read_text(encoding="utf-8"))["@graph"]
    described = {item["@id"]: item["sha256"] for item in graph if "sha256" in item}
    listed = {name: digest for name, digest in _manifest(folder).items() if name != METADATA}
    for name in sorted(set(described) ^ set(listed)):
        yield f"{name}: is in only one of {METADATA} and {MANIFEST}"
    for name in sorted(set(described) & set(listed)):
        if described[name] != listed[name]:
            yield f"{name}: has different checksums in {METADATA} and {MANIFEST}"


def _unsound_results(folder: Path) -> Iterator[str]:
    """Read the configuration, the card and each table by its contract."""
    try:
        config = archived_config(folder)
    except InputError as error:
        yield str(error)
        return
    surfaces = [study.name for study in config.studies if study.terms]
    for file, table, _ in result_files(surfaces):
        try:
            read_table(folder / "results" / "tables" / file, table.contract)
        except InputError as error:
            yield str(error)
    try:
        read_model(folder / "results" / "material_card.json", MaterialCard)
    except InputError as error:
        yield str(error)


def archived_config(folder: Path) -> Config:
    """Read the configuration of an unpacked archive.

    Raises
    ------
    InputError
        For a file that is not a configuration, and for every fault in one.
    """
    values = read_yaml(folder / CONFIGURATION)
    if not isinstance(values, dict):
        raise InputError("is not a configuration", file=folder / CONFIGURATION)
    return read_config(values, str(folder / CONFIGURATION))
