"""Which files of a project folder belong in the archive of a study, and their roles."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from enum import StrEnum
from pathlib import Path

import nptcs
from nptcs.config.root import Config
from nptcs.errors import InputError
from nptcs.ingest.folder import raw_files
from nptcs.solvers.registry import load_solver, module_of, read_options
from nptcs.tables.catalogue import result_files


class ArchivedAs(StrEnum):
    """Role of a file in the study."""

    INPUT = "input"
    RESULT = "result"
    CODE = "code"


RESULTS = ("report.html", "workbook.xlsx", "material_card.json", "configuration.yaml",
           "identity.json")  # fmt: skip
"""Results apart from the tables; if one of them is missing, the study is not finished."""
VERDICT = "verdict.txt"
"""Written only by a run in which every specimen and case gave a result."""
PACKAGES = ("nptcs", "snakemake_logger_plugin_nptcs")
"""Import packages; Snakemake finds the second by its name."""
CODE = ("Snakefile", "workflow/Snakefile", "workflow/rules/*.smk", "workflow/scripts/*.py",
        "workflow/report/*.rst", "profiles/*/*.yaml")  # fmt: skip
PROJECT = ("pyproject.toml", "constraints.txt", "Makefile", "LICENSE", "CITATION.cff", "README.md")
"""Files of a clone; a project folder with an installed package has none of them."""


def contents_of(root: Path, config: Config) -> dict[str, tuple[Path, ArchivedAs]]:
    """List the files of a study's archive.

    Parameters
    ----------
    root : Path
        The project folder.
    config : Config
        The configuration that the results were made with.

    Returns
    -------
    dict
        Name in the archive → the file and its role. The package's own source is among the code,
        wherever it is installed.

    Raises
    ------
    InputError
        For a result or an input that is missing or lies outside the project folder.
    """
    found: dict[str, tuple[Path, ArchivedAs]] = {}
    for path in study_inputs(root, config):
        found[_inside(path, root)] = (path, ArchivedAs.INPUT)
    for path in _results(root, config):
        found[_inside(path, root)] = (path, ArchivedAs.RESULT)
    for pattern in (*CODE, *PROJECT):
        for path in sorted(root.glob(pattern)):
            found.setdefault(_inside(path, root), (path, ArchivedAs.CODE))
    source = Path(nptcs.__file__).parents[1]
    for package in PACKAGES:
        for path in sorted((source / package).rglob("*")):
            if path.is_file() and "__pycache__" not in path.parts:
                name = f"workflow/src/{path.relative_to(source).as_posix()}"
                found.setdefault(name, (path, ArchivedAs.CODE))
    return found


def study_inputs(root: Path, config: Config) -> list[Path]:
    """List the files that a study reads: laboratory data, profiles, published tables, modules."""
    sheet = root / config.lab_data.specimen_sheet
    formats = root / config.lab_data.formats
    named = [*config.published_inputs(), *config.page_inputs()]
    for study in config.studies:
        for name, options in config.solver_options(study).items():
            named += _of_solver(name, options)
    listed = [sheet, *raw_files(sheet.parent).values(), *sorted(formats.glob("*.yaml"))]
    listed += [root / name for name in named]
    return list(dict.fromkeys(listed))


def _of_solver(name: str, options: Mapping[str, object]) -> Iterator[str]:
    """Yield the tables of a solver, and its module if that is a user's file."""
    module = module_of(name, options)
    yield from read_options(load_solver(module), options).tables().values()
    if module.endswith(".py"):
        yield module


def _results(root: Path, config: Config) -> Iterator[Path]:
    """Yield the results of a finished run."""
    folder = root / "results"
    surfaces = [study.name for study in config.studies if study.terms]
    needed = [*RESULTS, *(f"tables/{file}" for file, _, _ in result_files(surfaces))]
    for name in needed:
        if not (folder / name).is_file():
            raise InputError(
                "this result does not exist, so the study is not finished",
                "run snakemake to completion, then archive",
                folder / name,
            )
        yield folder / name
    if (folder / VERDICT).is_file():
        yield folder / VERDICT


def _inside(path: Path, root: Path) -> str:
    """Return the name of a file relative to the project folder."""
    if not path.is_file():
        raise InputError("this input does not exist", "correct the configuration", path)
    try:
        return path.absolute().relative_to(root.absolute()).as_posix()
    except ValueError:
        remedy = "copy it into the project folder, and name the copy in the configuration"
        raise InputError(
            "is outside the project folder, and an archive contains only that folder", remedy, path
        ) from None
