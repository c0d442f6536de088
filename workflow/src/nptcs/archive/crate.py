"""Write the archive: an RO-Crate in a zip file, with a checksum for each file in it."""

from __future__ import annotations

import hashlib
import json
import tempfile
import zipfile
from collections.abc import Mapping
from pathlib import Path
from typing import Any, assert_never

import yaml
from rocrate.rocrate import ROCrate

from nptcs import __version__
from nptcs.archive.contents import VERDICT, ArchivedAs
from nptcs.archive.environment import environment_facts
from nptcs.config.root import Config
from nptcs.files import atomic_path, sha256_of_file

METADATA = "ro-crate-metadata.json"
MANIFEST = "manifest-sha256.txt"
"""One line per file: its SHA-256, two blanks, its name; the format of ``sha256sum`` and BagIt."""
ENVIRONMENT = "environment.json"
CONFIGURATION = "config/config.yaml"
WORKFLOW = "workflow/Snakefile"


def write_crate(
    target: Path, files: Mapping[str, tuple[Path, ArchivedAs]], config: Config, commit: str
) -> int:
    """Write the archive of a finished study.

    Parameters
    ----------
    target : Path
        The zip file; it is written completely or not at all.
    files : mapping
        `nptcs.archive.contents.contents_of`.
    config : Config
        Configuration of the results; it becomes ``config/config.yaml`` of the archive.
    commit : str
        Commit of the code, or why it is not known.

    Returns
    -------
    int
        Number of files in the archive, without the manifest.
    """
    crate = ROCrate()
    crate.name = config.report.title
    crate.description = _description(files)
    crate.license = "MIT for the code; the laboratory's terms for its data"
    own = tempfile.TemporaryDirectory(prefix="nptcs-archive-")
    with own as folder, atomic_path(target) as temporary:
        made = _made_files(Path(folder), config)
        held = {**{name: path for name, (path, _) in files.items()}, **made}
        roles = {name: role for name, (_, role) in files.items()}
        sums = {name: sha256_of_file(path) for name, path in held.items()}
        _describe(crate, held, sums, roles, commit)
        crate.write_zip(temporary)
        with zipfile.ZipFile(temporary, "a", zipfile.ZIP_DEFLATED) as archive:
            sums[METADATA] = _sha256_in(archive, METADATA)
            lines = [f"{digest}  {name}\n" for name, digest in sorted(sums.items())]
            archive.writestr(MANIFEST, "".join(lines))
    return len(sums)


def _description(files: Mapping[str, tuple[Path, ArchivedAs]]) -> str:
    ended = (
        "Every specimen and case gave a result."
        if f"results/{VERDICT}" in files
        else "Some specimens or cases gave no result: results/tables/problems.csv lists them."
    )
    return (
        "A study of non-pneumatic tyres: inputs, configuration, code and results. "
        f"{ended} Run again with 'snakemake -j2' in the unpacked folder."
    )


def _made_files(folder: Path, config: Config) -> dict[str, Path]:
    """Write the files that only the archive has."""
    environment, configuration = folder / "environment.json", folder / "config.yaml"
    environment.write_text(json.dumps(environment_facts(), indent=1) + "\n", encoding="utf-8")
    values = config.model_dump(mode="json")
    text = yaml.safe_dump(values, allow_unicode=True, sort_keys=False)
    head = "# The whole configuration of the archived study, defaults included.\n"
    configuration.write_text(head + text, encoding="utf-8")
    return {ENVIRONMENT: environment, CONFIGURATION: configuration}


def _describe(
    crate: ROCrate,
    held: Mapping[str, Path],
    sums: Mapping[str, str],
    roles: Mapping[str, ArchivedAs],
    commit: str,
) -> None:
    """Add each file with its checksum, and the run that made the results."""
    inputs: list[Any] = []
    results: list[Any] = []
    for name, path in sorted(held.items()):
        properties = {"sha256": sums[name], "contentSize": str(path.stat().st_size)}
        if name == WORKFLOW:
            properties |= {"name": f"nptcs {__version__}", "version": __version__}
            workflow = crate.add_workflow(
                path, name, properties=properties, main=True, lang="snakemake"
            )
            workflow["codeCommit"] = commit
            continue
        entity = crate.add_file(path, name, properties=properties)
        match role := roles.get(name, ArchivedAs.INPUT):
            case ArchivedAs.INPUT:
                inputs.append(entity)
            case ArchivedAs.RESULT:
                results.append(entity)
            case ArchivedAs.CODE:
                pass  # neither read nor made by the run
            case _:
                assert_never(role)
    crate.add_action(
        crate.mainEntity,
        identifier="#run",
        object=inputs,
        result=results,
        properties={"name": f"Run of nptcs {__version__}, commit {commit}"},
    )


def _sha256_in(archive: zipfile.ZipFile, name: str) -> str:
    return hashlib.sha256(archive.read(name)).hexdigest()
