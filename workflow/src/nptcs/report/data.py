"""All results that the report and the workbook show, read from their files."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import pandas as pd
import pandera.pandas as pa

from nptcs.config.root import Config
from nptcs.config.studies.study import Study
from nptcs.files import read_model, sha256_of_file
from nptcs.lca.section import SectionKind
from nptcs.report.verdict import verdict
from nptcs.runs.identity import RunIdentity
from nptcs.runs.software import software_versions
from nptcs.solvers.lca import LcaOptions
from nptcs.surface.fit import Surface
from nptcs.surface.registry import SurfaceRegistry
from nptcs.surface.stored import read_registry, read_surfaces
from nptcs.tables.catalogue import file_of, result_files
from nptcs.tables.io import read_table
from nptcs.tables.laboratory.curves import IngestRecord, read_curves
from nptcs.tables.laboratory.material_card import MaterialCard, PlyCard, RubberCard
from nptcs.tables.laboratory.specimens import Specimen
from nptcs.tables.problems import Problems
from nptcs.tables.tyres.cases import Cases, DesignTable


@dataclass(frozen=True)
class SolverDescription:
    """What the report says about a solver, with the models that its options choose."""

    about: str
    needs_ply: bool
    loads_tyre: bool
    choices: Sequence[Mapping[str, str]] = ()
    whole_plates: bool = False


@dataclass(frozen=True)
class LcaRing:
    """The load-bearing model as used by the first study of the run that has it.

    Parameters
    ----------
    section : {"sandwich", "printed"}
        Section of the shear band.
    file : str
        The table of spoke stiffness.
    rows : sequence of mapping
        Its rows.
    """

    section: SectionKind
    file: str
    rows: Sequence[Mapping[Any, Any]]


@dataclass(frozen=True)
class Results:
    """Everything that a run has made.

    ``tables`` holds the tables of ``results/tables`` by file name; `table` returns one by its
    contract. ``surfaces`` are the polynomials of the stiffness by study and solver, ``models`` the
    surfaces of every kind and response by study.
    """

    config: Config
    sheet: tuple[Specimen, ...]
    solvers: Mapping[str, SolverDescription]
    software: Mapping[str, str]
    inputs: Mapping[str, str]
    card: MaterialCard
    curves: Mapping[str, pd.DataFrame]
    records: Mapping[str, IngestRecord]
    designs: Mapping[str, pd.DataFrame]
    surfaces: Mapping[str, Mapping[str, Surface]]
    tables: Mapping[str, pd.DataFrame]
    models: Mapping[str, SurfaceRegistry] = field(default_factory=dict)
    lca_ring: LcaRing | None = None
    identity: RunIdentity | None = None

    def table(self, contract: type[pa.DataFrameModel], study: str = "") -> pd.DataFrame:
        """Return the result table of a contract; `study` names the one of a table per study."""
        return self.tables[file_of(contract, study)]

    @property
    def surface_studies(self) -> list[str]:
        """Names of the studies that request a surface."""
        return [study.name for study in self.config.studies if study.terms]

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
        return verdict(self.table(Problems), self.table(Cases), self.sheet, self.records)

    def left_out(self) -> dict[str, str]:
        """Name the specimens that the sheet leaves out, with the reason."""
        return {s.specimen: s.reason for s in self.sheet if not s.include}

    def failed(self) -> dict[str, str]:
        """Name the specimens that could not be read, with the message."""
        return {
            name: record.message for name, record in self.records.items() if not record.understood
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
        """Tell whether any row of a table with study and solver rests on synthetic specimens."""
        return any(
            self.study_is_synthetic(self.config.study(study), solver)
            for study, solver in table[["study", "solver"]].drop_duplicates().to_numpy()
        )


def read_results(job: Mapping[str, Any], files: Mapping[str, Any]) -> Results:
    """Read all results of a run, each table checked against its contract.

    Parameters
    ----------
    job : mapping
        ``config``, ``specimens`` (rows of the sheet), ``solvers`` (`SolverDescription` by name), as
        plain values.
    files : mapping
        A path for ``card`` and one for ``identity``; lists of paths under ``tables`` (all of
        ``results/tables``), ``curves``, ``records``, ``designs``, ``surfaces``, ``models`` (these
        three named by their study) and ``inputs``.

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
    paths = {Path(file).name: file for file in files["tables"]}
    designs = {Path(file).stem: file for file in files["designs"]}
    surfaces = {Path(file).stem: file for file in files["surfaces"]}
    records = [read_model(file, IngestRecord) for file in files["records"]]
    return Results(
        config=config,
        sheet=tuple(Specimen.model_validate(row) for row in job["specimens"]),
        solvers={name: SolverDescription(**facts) for name, facts in job["solvers"].items()},
        software=software_versions(),
        inputs={str(file): sha256_of_file(file) for file in files["inputs"]},
        card=read_model(files["card"], MaterialCard),
        curves=read_curves(files["curves"]),
        records={record.specimen: record for record in records},
        designs={name: read_table(designs[name], DesignTable) for name in studies},
        surfaces={name: read_surfaces(surfaces[name]) for name in with_surface},
        tables={
            name: read_table(paths[name], row.contract)
            for name, row, _ in result_files(with_surface)
        },
        models={Path(file).stem: read_registry(file) for file in files["models"]},
        lca_ring=_lca_ring(config),
        identity=read_model(files["identity"], RunIdentity),
    )


def _lca_ring(config: Config) -> LcaRing | None:
    """Read the spokes of the load-bearing model; None where no study uses it.

    None, too, where its spokes are not two stiffnesses: a model with a curve for each spoke is not
    evaluated on the page.
    """
    study = next((study for study in config.studies if "lca" in study.solvers), None)
    if study is None:
        return None
    options = LcaOptions.model_validate(config.options_of(study.name, "lca"))
    file = options.tables().get("spoke_stiffness")
    if file is None or options.contact_spokes != "paper":
        return None
    rows = pd.read_csv(file).to_dict("records")
    return LcaRing(options.section, file, rows)
