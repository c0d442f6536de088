"""Cheap cases in bulk: a table of cases solved in parts, its results kept as columns.

A solver with a table function (`nptcs.solvers.contract.Solver.solve_table`) solves the cases of a
large study in parts, each in a separate process: a part whose process dies or runs out of time
is halved until the cases at fault are found. There is no record per case; of the curves, the
points are kept as columns.
"""

from __future__ import annotations

import hashlib
import json
import multiprocessing
import time
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from multiprocessing.connection import Connection, wait
from multiprocessing.process import BaseProcess
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from nptcs.campaign import bulk_worker
from nptcs.campaign.bulk_file import read_bulk, write_bulk
from nptcs.campaign.progress import ProgressWriter
from nptcs.campaign.record import read_solver_tables
from nptcs.campaign.runner import (
    SENT_FROM_OUTSIDE,
    case_environment,
    case_folder,
    cause_of_death,
    stop,
    without_main_file,
)
from nptcs.campaign.schedule import cases_side_by_side
from nptcs.config.solvers.tyre import TyreGeometry
from nptcs.config.studies.study import Study
from nptcs.errors import InputError
from nptcs.files import sha256_of_text
from nptcs.provenance import code_hash
from nptcs.solvers.contract import Solver, Status, TableInputs
from nptcs.solvers.registry import load_solver, module_of, read_options
from nptcs.tables.status import has_result

OUTSIDE = [status.value for status in Status if status.from_outside]

FIRST = ("study", "case_id", "solver", "status", "message")
LAST = ("wall_time_s", "solver_version", "key")
"""Columns at both ends of the table of results, as in ``cases.csv``."""


def in_bulk(solver: Solver, cases: int, bulk_from: int) -> bool:
    """Tell whether a solver solves the cases of a study as a table."""
    return solver.solve_table is not None and cases >= bulk_from


@dataclass(frozen=True)
class _Task:
    """What all parts of a table share."""

    module: str
    inputs: TableInputs
    timeout_s: float
    most_cases: int

    def part(self, rows: np.ndarray) -> TableInputs:
        """Return the inputs of some rows."""
        inputs = self.inputs
        cases = inputs.cases.iloc[rows].reset_index(drop=True)
        return replace(inputs, cases=cases, options=None)


@dataclass(eq=False)
class _Running:
    rows: np.ndarray
    process: BaseProcess
    channel: Connection
    folder: Path
    started: float


@dataclass(frozen=True)
class _Table:
    """Cases of a study with everything that one solver may look at."""

    solver: Solver
    module: str
    inputs: TableInputs

    @classmethod
    def of(
        cls,
        study: Study,
        solver_name: str,
        options: Mapping[str, Any],
        tyre: TyreGeometry,
        cases: pd.DataFrame,
        ply: Mapping[str, float] | None,
    ) -> _Table:
        """Join the cases of a design with what all of them share."""
        module = module_of(solver_name, options)
        solver = load_solver(module)
        checked = read_options(solver, options)
        given = dict(ply) if solver.needs_ply and ply is not None else None
        values = cases.drop(columns="case").reset_index(drop=True)
        tables = read_solver_tables(checked.tables())
        return cls(solver, module, TableInputs(values, study.load_n, tyre, checked, given, tables))

    def folder(self, store: str | Path) -> Path:
        """Return the folder of the solved cases that differ from these in their values only."""
        inputs, options = self.inputs, self.inputs.options
        content = {
            "solver": self.solver.name,
            "solver_version": self.solver.version,
            "code": code_hash(self.module),
            "load_n": inputs.load_n,
            "tyre": inputs.tyre.model_dump(mode="json"),
            "ply": inputs.ply,
            "options": options.model_dump(mode="json", exclude=set(options.without_effect)),
            "tables": inputs.tables,
        }
        return Path(store) / "bulk" / sha256_of_text(json.dumps(content, sort_keys=True))

    def keys(self) -> pd.Series:
        """Content address of each case within its folder: the same values, the same result."""
        cases = self.inputs.cases
        names = sorted(str(name) for name in cases if name != "case_id")
        start = hashlib.sha256(json.dumps(names).encode())
        keys = []
        for values in cases[names].to_numpy(float):
            digest = start.copy()
            digest.update(values.tobytes())
            keys.append(digest.hexdigest())
        return pd.Series(keys, name="key", dtype=object)


def known_in_bulk(
    study: Study,
    solver_name: str,
    options: Mapping[str, Any],
    tyre: TyreGeometry,
    design: pd.DataFrame,
    ply: Mapping[str, float] | None,
    store: str | Path,
) -> int:
    """Count the cases of a design that are solved already, for the plan of a run."""
    table = _Table.of(study, solver_name, options, tyre, design, ply)
    return int(table.keys().isin(_stored(table.folder(store))["key"]).sum())


def solve_bulk(
    job: Mapping[str, Any],
    design: pd.DataFrame,
    ply: Mapping[str, float] | None,
    store: str | Path,
    cores: int,
    tokens: int,
    log: str | Path,
) -> tuple[pd.DataFrame, bool]:
    """Solve every n-th case of a design, starting at the batch's own number.

    Parameters
    ----------
    job, design, ply, cores, tokens, log
        As in `nptcs.campaign.batch.solve_batch`.
    store : str or Path
        Folder of solved cases. Those found there are not solved again; new ones are kept part
        by part, so that an interrupted run continues where it stopped.

    Returns
    -------
    table : DataFrame
        One row per case, in the columns of ``cases.csv``; failed cases included.
    again : bool
        Whether a case ended for a reason outside it, so that the next run should try it again.
    """
    study, tyre = Study.model_validate(job["study"]), TyreGeometry.model_validate(job["tyre"])
    cases = design.iloc[job["batch"] - 1 :: job["batches"]].reset_index(drop=True)
    table = _Table.of(study, job["solver"], job["options"], tyre, cases, ply)
    solver, inputs, options = table.solver, table.inputs, table.inputs.options
    folder, keys = table.folder(store), table.keys()
    known = _stored(folder)
    missing = np.flatnonzero(~keys.isin(known["key"]).to_numpy())
    task = _Task(table.module, inputs, options.timeout_s, solver.table_cases)
    solved, at_a_time = [known], cases_side_by_side(cores, tokens, options)
    progress = ProgressWriter(log, study.name, solver.name, at_a_time)
    began = time.monotonic()
    for rows, results in _solve(task, missing, at_a_time):
        part = results.assign(key=keys.iloc[rows].to_numpy())
        good = part[has_result(part["status"])]
        if len(good):
            write_bulk(folder / f"{sha256_of_text(''.join(good['key']))[:32]}.npz", good)
        solved.append(part)
        done = len(cases) - len(missing) + sum(map(len, solved[1:]))
        bad = sum(int((~has_result(one["status"])).sum()) for one in solved[1:])
        new = sum(map(len, solved[1:]))
        progress.part(done, len(cases), bad, time.monotonic() - began, new)
    everything = pd.concat([one for one in solved if len(one)], ignore_index=True)
    results = everything.drop_duplicates("key").set_index("key").reindex(keys).reset_index()
    outside = results["status"].isin(OUTSIDE) | (results[bulk_worker.DIED] > 0)
    results = results.drop(columns=bulk_worker.DIED)
    return _as_cases(study, solver, inputs, results), bool(outside.any())


def _as_cases(
    study: Study, solver: Solver, inputs: TableInputs, results: pd.DataFrame
) -> pd.DataFrame:
    """Put cases and results into the columns of ``cases.csv``."""
    cases = inputs.cases
    table = pd.concat([cases, results], axis=1)
    table = table.assign(
        study=study.name, solver=solver.name, solver_version=solver.version, load_n=inputs.load_n
    )
    values = [str(name) for name in cases if name != "case_id"]
    rest = [str(name) for name in results if name not in (*FIRST, *LAST)]
    return table[[*FIRST, *values, "load_n", *rest, *LAST]]


def _stored(folder: Path) -> pd.DataFrame:
    """Read the solved cases of a folder; a file that is damaged or edited is a miss."""
    tables = []
    for file in sorted(folder.glob("*.npz")):
        try:
            tables.append(read_bulk(file))
        except InputError:
            continue
    if not tables:
        return pd.DataFrame({"key": pd.Series(dtype=object)})
    found = pd.concat(tables, ignore_index=True)
    return found[has_result(found["status"])]


def _solve(
    task: _Task, rows: np.ndarray, at_a_time: int
) -> Iterator[tuple[np.ndarray, pd.DataFrame]]:
    """Solve rows in parts; yield each part with its results as it ends."""
    context = multiprocessing.get_context("forkserver")
    preload = [] if task.module.endswith(".py") else [task.module]
    context.set_forkserver_preload(["nptcs.campaign.bulk_worker", *preload])
    size = max(1, min(task.most_cases, -(-len(rows) // at_a_time)))
    queue = [rows[start : start + size] for start in range(0, len(rows), size)][::-1]
    running: list[_Running] = []
    try:
        while queue or running:
            while queue and len(running) < at_a_time:
                running.append(_start(task, queue.pop()))
            for part in _ended(running, task.timeout_s):
                running.remove(part)
                results, halves = _collect(part, task.timeout_s)
                queue += halves
                if results is not None:
                    yield part.rows, results
    finally:
        for part in running:
            part.process.terminate()
        for part in running:
            stop(part.process, part.folder)


def _start(task: _Task, rows: np.ndarray) -> _Running:
    context = multiprocessing.get_context("forkserver")
    receive, send = context.Pipe(duplex=False)
    options = task.inputs.options.model_dump(mode="json")
    folder = case_folder()
    arguments = (task.module, options, task.part(rows), send, str(folder))
    process = context.Process(target=bulk_worker.run, args=arguments)
    with without_main_file(), case_environment():
        process.start()
    send.close()
    return _Running(rows, process, receive, folder, time.monotonic())


def _ended(running: list[_Running], timeout_s: float) -> list[_Running]:
    """Wait until a part has sent its results, died or run out of time; return all that have."""
    left = min(part.started for part in running) + timeout_s - time.monotonic()
    ready = wait([part.channel for part in running], timeout=max(0.0, left))
    now = time.monotonic()
    return [part for part in running if part.channel in ready or now - part.started >= timeout_s]


def _collect(part: _Running, timeout_s: float) -> tuple[pd.DataFrame | None, list[np.ndarray]]:
    """Take the results of a part that has ended; if there are none, return its halves to solve."""
    seconds, died = time.monotonic() - part.started, False
    try:
        if part.channel.poll():
            results, taken_s = part.channel.recv()
            return results.assign(wall_time_s=taken_s / len(part.rows)), []
        status = Status.TIMEOUT
        message = f"stopped after {seconds:.1f} s (timeout_s = {timeout_s:g})"
    except EOFError:
        part.process.join(2.0)
        code = part.process.exitcode
        status, message = Status.ERROR, cause_of_death(code)
        died = code is not None and -code in SENT_FROM_OUTSIDE
    finally:
        part.channel.close()
        stop(part.process, part.folder)
    if len(part.rows) > 1:
        half = len(part.rows) // 2
        return None, [part.rows[half:], part.rows[:half]]
    failed = bulk_worker.failed_row(status, message, died)
    return failed.assign(wall_time_s=seconds), []
