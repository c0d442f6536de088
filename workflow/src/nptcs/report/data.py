"""All results that the report and the workbook lay out, read from their files."""

from __future__ import annotations

import platform
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from importlib.metadata import version
from pathlib import Path
from typing import Any

import pandas as pd

from nptcs import __version__
from nptcs.config.root import Config
from nptcs.config.study import Study
from nptcs.files import sha256_of_file
from nptcs.report.figures.surface import FactorLabel
from nptcs.report.verdict import verdict
from nptcs.surface.fit import Surface
from nptcs.surface.stored import load
from nptcs.tables.cases import Design
from nptcs.tables.catalogue import TABLES
from nptcs.tables.curves import Curve, IngestRecord
from nptcs.tables.io import read_table
from nptcs.tables.material_card import MaterialCard, PlyCard, RubberCard
from nptcs.tables.specimens import Specimen
from nptcs.tables.surface import SurfaceTable

PLAIN_TABLES = {
    "files": "files.csv",
    "specimens": "specimens.csv",
    "statistics": "statistics.csv",
    "models": "hyperelastic_models.csv",
    "ranges": "c10_against_range.csv",
    "cases": "cases.csv",
    "quality": "surface_quality.csv",
    "impact": "impact.csv",
    "spoke_stiffness": "spoke_stiffness.csv",
    "spoke_curves": "spoke_curves.csv",
    "compare_published": "stiffness_against_published.csv",
    "stiffness_errors": "stiffness_errors.csv",
    "stiffness_by_level": "stiffness_by_level.csv",
    "neutral_line": "neutral_line.csv",
    "lca_validation": "lca_validation.csv",
    "lca_against_fem": "lca_against_fem.csv",
    "lca_neutral_line": "lca_neutral_line.csv",
    "problems": "problems.csv",
}
"""Fields of `Results` that are one table each, and their names among the contracts."""

SOFTWARE = (
    "snakemake",
    "numpy",
    "scipy",
    "pandas",
    "scikit-learn",
    "matplotlib",
    "openpyxl",
)


@dataclass(frozen=True)
class SolverFacts:
    """What the report says of a solver, with the models that its options choose."""

    about: str
    needs_ply: bool
    loads_tyre: bool
    choices: Sequence[Mapping[str, str]] = ()


@dataclass(frozen=True)
class Results:
    """Everything that a run has made. Tables keep the columns of their contracts."""

    config: Config
    sheet: tuple[Specimen, ...]
    solvers: Mapping[str, SolverFacts]
    software: Mapping[str, str]
    inputs: Mapping[str, str]
    card: MaterialCard
    curves: Mapping[str, pd.DataFrame]
    records: Mapping[str, IngestRecord]
    designs: Mapping[str, pd.DataFrame]
    surfaces: Mapping[str, Mapping[str, Surface]]
    coefficients: Mapping[str, pd.DataFrame]
    files: pd.DataFrame
    specimens: pd.DataFrame
    statistics: pd.DataFrame
    models: pd.DataFrame
    ranges: pd.DataFrame
    cases: pd.DataFrame
    quality: pd.DataFrame
    impact: pd.DataFrame
    spoke_stiffness: pd.DataFrame
    spoke_curves: pd.DataFrame
    compare_published: pd.DataFrame
    stiffness_errors: pd.DataFrame
    stiffness_by_level: pd.DataFrame
    neutral_line: pd.DataFrame
    lca_validation: pd.DataFrame
    lca_against_fem: pd.DataFrame
    lca_neutral_line: pd.DataFrame
    problems: pd.DataFrame

    @property
    def any_synthetic(self) -> bool:
        """True if any specimen of the sheet is synthetic."""
        return any(specimen.origin == "synthetic" for specimen in self.sheet)

    @property
    def cards(self) -> list[PlyCard | RubberCard]:
        """The cards of all plies and rubbers."""
        return [*self.card.plies.values(), *self.card.rubbers.values()]

    @property
    def plies_synthetic(self) -> bool:
        """True if any ply constant rests on synthetic specimens."""
        return any(ply.synthetic for ply in self.card.plies.values())

    @property
    def rubbers_synthetic(self) -> bool:
        """True if any rubber constant rests on synthetic specimens."""
        return any(rubber.synthetic for rubber in self.card.rubbers.values())

    def verdict(self) -> tuple[bool, str]:
        """Say in one line whether everything gave a result, with counts."""
        return verdict(self.problems, self.cases, self.sheet, self.records)

    def left_out(self) -> dict[str, str]:
        """Name the specimens that the sheet leaves out, with the reason."""
        return {s.specimen: s.reason for s in self.sheet if not s.include}

    def failed(self) -> dict[str, str]:
        """Name the specimens that could not be read, with the message."""
        return {
            name: record.message for name, record in self.records.items() if record.status != "ok"
        }

    def series(self) -> dict[str, list[Specimen]]:
        """Group the specimens of the sheet by series, in the sheet's order."""
        groups: dict[str, list[Specimen]] = {}
        for specimen in self.sheet:
            groups.setdefault(specimen.series, []).append(specimen)
        return groups

    def study_is_synthetic(self, study: Study, solver: str | None = None) -> bool:
        """Tell whether a study, or what one solver makes of it, rests on synthetic specimens."""
        named = [self.card.rubbers[name] for name in study.rubbers() if name in self.card.rubbers]
        if any(rubber.synthetic for rubber in named):
            return True
        solvers = study.solvers if solver is None else (solver,)
        with_ply = any(self.solvers[name].needs_ply for name in solvers)
        return with_ply and self.plies_synthetic

    def table_is_synthetic(self, table: pd.DataFrame) -> bool:
        """Tell whether any row of a table with the columns study and solver rests on such data."""
        return any(
            self.study_is_synthetic(self.config.study(study), solver)
            for study, solver in table[["study", "solver"]].drop_duplicates().to_numpy()
        )


def factor_labels(study: Study) -> dict[str, FactorLabel]:
    """Return how a study's factors are written in figures."""
    return {factor.name: FactorLabel(factor.label, factor.unit) for factor in study.factors}


def read_results(job: Mapping[str, Any], files: Mapping[str, Any]) -> Results:
    """Read all results of a run, each table checked against its contract.

    Parameters
    ----------
    job : mapping
        ``config``, ``specimens`` (rows of the sheet), ``solvers`` (`SolverFacts` by name), as
        plain values.
    files : mapping
        A path for each of `PLAIN_TABLES` and for ``card``; lists of paths under ``curves``,
        ``records``, ``designs``, ``surfaces``, ``coefficients`` and ``inputs``: designs in the
        order of the studies, surfaces and coefficients in that of the studies that have terms.

    Returns
    -------
    Results

    Raises
    ------
    InputError
        For a table that is missing or breaks its contract.
    """
    config = Config.model_validate(job["config"])
    studies = [study.name for study in config.studies]
    with_surface = [study.name for study in config.studies if study.terms]
    designs = [read_table(file, Design) for file in files["designs"]]
    coefficients = [read_table(file, SurfaceTable) for file in files["coefficients"]]
    surfaces = [load(Path(file).read_text("utf-8")) for file in files["surfaces"]]
    return Results(
        config=config,
        sheet=tuple(Specimen.model_validate(row) for row in job["specimens"]),
        solvers={name: SolverFacts(**facts) for name, facts in job["solvers"].items()},
        software={
            "nptcs": __version__,
            "Python": platform.python_version(),
            **{name: version(name) for name in SOFTWARE},
        },
        inputs={str(file): sha256_of_file(file) for file in files["inputs"]},
        card=MaterialCard.model_validate_json(Path(files["card"]).read_text("utf-8")),
        curves={
            Path(file).name.removesuffix(".csv"): read_table(file, Curve)
            for file in files["curves"]
        },
        records={record.specimen: record for record in map(_read_record, files["records"])},
        designs=dict(zip(studies, designs, strict=True)),
        surfaces=dict(zip(with_surface, surfaces, strict=True)),
        coefficients=dict(zip(with_surface, coefficients, strict=True)),
        **{
            name: read_table(files[name], TABLES[table].contract)
            for name, table in PLAIN_TABLES.items()
        },
    )


def _read_record(file: str) -> IngestRecord:
    return IngestRecord.model_validate_json(Path(file).read_text("utf-8"))
