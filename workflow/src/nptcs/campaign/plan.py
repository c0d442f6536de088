"""What a run would solve: how many cases, how many of them are known, and what they will cost."""

from __future__ import annotations

import math
import shutil
from dataclasses import dataclass
from itertools import islice
from pathlib import Path
from statistics import mean, median

from nptcs.campaign.answers import Asked, rounding_notes, solvers_of
from nptcs.campaign.bulk import in_bulk, known_in_bulk
from nptcs.campaign.jobs import make_jobs
from nptcs.campaign.queue import batch_count
from nptcs.campaign.record import CaseRecord, RecordStore
from nptcs.campaign.schedule import batch_cores
from nptcs.config.root import Config
from nptcs.config.solvers.tyre import TyreGeometry
from nptcs.config.studies.study import Study
from nptcs.design import build_design
from nptcs.errors import InputError
from nptcs.files import read_model
from nptcs.solvers.contract import Solver, SolverOptions
from nptcs.tables.laboratory.material_card import MaterialCard

SAMPLE = 300
"""Newest stored records from which the cost of a case is estimated."""


RECORD_MB = 0.03
"""Size of a record if none is stored: a tyre's curve and its neutral line."""

BULK_RECORD_MB = 2.5e-4
"""Size of a case among results in bulk: in the store, and in the file of its batch."""


@dataclass(frozen=True)
class Costs:
    """Mean time and median sizes of the stored cases of one solver, or what the solver states.

    Cases that share a part with an earlier one (`Solver.shares`) take `shared_seconds`.
    """

    seconds: float
    memory_mb: float | None
    record_mb: float
    measured: bool = True
    shared_seconds: float | None = None

    def total_s(self, cases: int, parts: int) -> float:
        """Time of cases that have this number of different parts between them."""
        if self.shared_seconds is None:
            return cases * self.seconds
        own = min(parts, cases)
        return own * self.seconds + (cases - own) * self.shared_seconds


def costs_by_solver(store: RecordStore) -> dict[str, Costs]:
    """Return the cost of a case by solver, from the newest records of a store."""
    files = sorted(store.folder.glob("??/*.json"), key=lambda file: -file.stat().st_mtime)
    found: dict[str, list[tuple[CaseRecord, float]]] = {}
    for file in islice(files, SAMPLE):
        try:
            record = read_model(file, CaseRecord)
        except InputError:
            continue
        found.setdefault(record.solver, []).append((record, file.stat().st_size / 1e6))
    return {solver: _costs(records) for solver, records in found.items()}


def _costs(records: list[tuple[CaseRecord, float]]) -> Costs:
    memory = [r.peak_memory_mb for r, _ in records if r.peak_memory_mb is not None]
    return Costs(
        mean(record.wall_time_s for record, _ in records),
        median(memory) if memory else None,
        median(size for _, size in records),
    )


def known_cases(
    study: Study, config: Config, card: MaterialCard | None, store: RecordStore
) -> dict[str, int | None]:
    """Count the stored cases of each solver; None if the materials are not known yet."""
    options = config.solver_options(study)
    rubbers = card.rubbers if card is not None else {}
    c10 = {name: rubber.constants["c10_mpa"].value for name, rubber in rubbers.items()}
    plies = dict(card.plies) if card is not None else {}
    if study.ply is not None:
        plies = {name: ply for name, ply in plies.items() if name == study.ply}
    known: dict[str, int | None] = {}
    for solver, _ in solvers_of(study, options):
        lacks_ply = solver.needs_ply and len(plies) != 1
        if lacks_ply or not set(study.rubbers()) <= set(c10):
            known[solver.name] = None
            continue
        ply = next(iter(plies.values())).values() if solver.needs_ply else None
        given = options[solver.name]
        design = build_design(study, c10, config.tyre)
        if in_bulk(solver, len(design), config.campaign.bulk_from):
            given_table = (study, solver.name, given, config.tyre, design, ply)
            known[solver.name] = known_in_bulk(*given_table, store.folder)
            continue
        jobs = make_jobs(study, solver.name, given, config.tyre, design, ply)
        known[solver.name] = sum(store.read(job) is not None for job in jobs)
    return known


def plan_lines(config: Config, results: str | Path = "results") -> list[str]:
    """Describe what a run would solve: one line per study and solver, and the disk space.

    Parameters
    ----------
    config : Config
        Without faults (`nptcs.campaign.checks.study_faults`).
    results : str or Path
        Folder of earlier results; times, memory and known cases are taken from it.
    """
    store = RecordStore(Path(results) / "5_solve" / "records")
    card_file = Path(results) / "material_card.json"
    card = read_model(card_file, MaterialCard) if card_file.is_file() else None
    costs = costs_by_solver(store)
    lines, disk_mb = [], 0.0
    for study in config.studies:
        known, solvers = known_cases(study, config, card, store), ", ".join(study.solvers)
        cases = f"{study.number_of_cases():,} cases ({study.design.kind})"
        lines.append(f"study {study.name}: {cases} by {solvers}")
        rounded = rounding_notes(Asked.of(study, config.solver_options(study), config.tyre))
        for solver, checked in solvers_of(study, config.solver_options(study)):
            batches = batch_count(study.number_of_cases(), config.campaign, checked)
            batch = study.number_of_cases() / batches
            cores = batch_cores(config.campaign.cores_per_batch, checked, batch)
            at_a_time = max(1, cores // checked.cores_per_case())
            bulk = in_bulk(solver, study.number_of_cases(), config.campaign.bulk_from)
            cost = _stated(solver, checked, bulk)
            if not bulk:
                cost = costs.get(solver.name, cost)
            parts = different_parts(study, solver, config.tyre)
            words, needed_mb = _words(
                study.number_of_cases(), known[solver.name], parts, cost, at_a_time
            )
            lines.append(f"  {solver.name}: {words}")
            if solver.name in rounded:
                lines.append(f"    rounded: {rounded[solver.name]}")
            disk_mb += needed_mb
    free = shutil.disk_usage(Path(results) if Path(results).is_dir() else Path()).free / 1e6
    lines.append(f"disk: about {disk_mb:.3g} MB for new records, {free:,.0f} MB are free")
    return lines


def _stated(solver: Solver, checked: SolverOptions, bulk: bool) -> Costs:
    """Return what a solver states about the cost of its cases."""
    return Costs(
        (solver.table_case_s if bulk else None) or checked.case_s,
        checked.case_memory_mb,
        BULK_RECORD_MB if bulk else RECORD_MB,
        measured=False,
        shared_seconds=solver.shared_case_s if solver.shares else None,
    )


def different_parts(study: Study, solver: Solver, tyre: TyreGeometry) -> int:
    """Count the different parts that the cases of a study share: for a joint study, its spokes.

    Rubbers of the card do not vary within a study: their values make no difference here.
    """
    if not solver.shares:
        return study.number_of_cases()
    design = build_design(study, dict.fromkeys(study.rubbers(), 1.0), tyre)
    varied = [name for name in design.columns if name in solver.shares]
    return len(design[varied].drop_duplicates()) if varied else 1


def _words(
    cases: int, known: int | None, parts: int, cost: Costs, at_a_time: int
) -> tuple[str, float]:
    """Describe what one solver has to do; also return the space of its records in MB."""
    if known is None:
        new, how_many = cases, "known cases are counted once the materials are calibrated"
    else:
        new, how_many = cases - known, f"{known:,} known, {cases - known:,} to solve"
    if new == 0:
        return how_many, 0.0
    seconds = cost.total_s(new, math.ceil(parts * new / cases)) / at_a_time
    time = f"{seconds:.2g} s" if seconds < 100 else f"{seconds / 60:,.0f} min"
    memory = "" if cost.memory_mb is None else f", {cost.memory_mb * at_a_time:,.0f} MB of memory"
    source = "" if cost.measured else " (stated by the solver; none of its cases is stored)"
    words = f"{how_many}; about {time} with {at_a_time} at a time{memory}{source}"
    return words, new * cost.record_mb
