"""The record of one solver case, kept under a hash of everything that decides its content."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping, Sequence
from itertools import groupby, zip_longest
from pathlib import Path
from typing import Any, Self

from pydantic import BaseModel, ConfigDict, Field, ValidationError, model_validator

from nptcs.errors import InputError
from nptcs.files import REWRITE, read_model, read_stored, sha256_of_text, write_model, write_text
from nptcs.seal import BrokenSealError, open_lines, sealed_lines
from nptcs.solvers.contract import SolverResult, missing_responses


class CaseJob(BaseModel):
    """One case as it is handed to a solver's process.

    It contains everything that decides the result, and apart from that only the case's name and
    its time limit. `key` is made from it.
    """

    model_config = ConfigDict(extra="forbid", frozen=True)

    study: str
    case_id: str
    solver: str
    solver_version: str
    module: str = Field(description="Module or file that defines the solver")
    code: str = Field(description="Hash of the solver's code and of all that it imports")
    values: dict[str, float]
    load_n: float | None = Field(description="None for a solver that loads no tyre")
    tyre: dict[str, Any]
    ply: dict[str, float] | None
    options: dict[str, Any]
    without_effect: tuple[str, ...] = Field(description="Options that are not part of the key")
    tables: dict[str, list[dict[str, Any]]]

    @property
    def key(self) -> str:
        """The content address: cases with the same key have the same result."""
        content = self.model_dump(exclude={"study", "case_id", "module", "without_effect"})
        for name in self.without_effect:
            content["options"].pop(name, None)
        return sha256_of_text(json.dumps(content, sort_keys=True))

    @property
    def timeout_s(self) -> float:
        """Wall time after which the case is stopped."""
        return float(self.options["timeout_s"])


class CaseRecord(BaseModel):
    """How one case ended: one line of a batch file, one row of ``cases.csv``."""

    model_config = ConfigDict(extra="forbid", allow_inf_nan=False)

    study: str
    case_id: str
    solver: str
    solver_version: str
    key: str
    values: dict[str, float]
    load_n: float | None
    wall_time_s: float = Field(description="Time of the run that made the result")
    peak_memory_mb: float | None = Field(
        None, description="Largest memory of the case's process; none if it died"
    )
    result: SolverResult

    @model_validator(mode="after")
    def _ok_has_its_responses(self) -> Self:
        missing = missing_responses(self.result, loads_tyre=self.load_n is not None)
        if missing:
            raise ValueError(f"{self.case_id}: status ok, but no {', '.join(missing)}")
        return self


def make_record(
    job: CaseJob, result: SolverResult, wall_time_s: float, peak_memory_mb: float | None = None
) -> CaseRecord:
    """Join a job and its result."""
    return CaseRecord(
        study=job.study,
        case_id=job.case_id,
        solver=job.solver,
        solver_version=job.solver_version,
        key=job.key,
        values=job.values,
        load_n=job.load_n,
        wall_time_s=wall_time_s,
        peak_memory_mb=peak_memory_mb,
        result=result,
    )


class RecordStore:
    """A folder with one JSON file per solved case, named by the case's key."""

    def __init__(self, folder: str | Path) -> None:
        self.folder = Path(folder)

    def path(self, key: str) -> Path:
        """Return where the record of that key is kept."""
        return self.folder / key[:2] / f"{key}.json"

    def read(self, job: CaseJob) -> CaseRecord | None:
        """Return the record of a case that was solved before; None if there is no intact one.

        A file that is unreadable, damaged or edited is a miss. The case's name is the job's,
        because two studies may share a record.
        """
        try:
            record = read_model(self.path(job.key), CaseRecord)
        except (OSError, InputError):
            return None
        if record.key != job.key or not record.result.status.solved:
            return None
        return record.model_copy(update={"study": job.study, "case_id": job.case_id})

    def write(self, record: CaseRecord) -> None:
        """Keep a solved case; a failed one is not kept, so that it can be tried again."""
        if record.result.status.solved:
            write_model(self.path(record.key), record)


def read_records(paths: Sequence[str]) -> list[CaseRecord]:
    """Read batch files: one record per line.

    Parameters
    ----------
    paths : sequence of str
        All batches of a study by a solver are in one folder, in the order of their numbers.

    Returns
    -------
    list of CaseRecord
        In the order of the designs, whatever the number of batches: batch k of n has every n-th
        case from the k-th on.

    Raises
    ------
    InputError
        For a file that is missing, or that lost, doubled or changed a line.
    """
    return [
        record
        for _, batches in groupby(paths, key=os.path.dirname)
        for turn in zip_longest(*map(_read_batch, batches))
        for record in turn
        if record is not None
    ]


def _read_batch(path: str) -> list[CaseRecord]:
    try:
        lines = open_lines(read_stored(path, "batch of case records"), "CaseRecords")
        return [CaseRecord.model_validate_json(line) for line in lines]
    except (BrokenSealError, ValidationError) as error:
        reason = " ".join(str(error).splitlines()[:3])
        raise InputError(f"these case records cannot be used: {reason}", REWRITE, path) from None


def write_records(path: str | Path, records: Sequence[CaseRecord]) -> None:
    """Write a batch file, atomically: one record per line, then the checksum of all."""
    write_text(path, sealed_lines([record.model_dump_json() for record in records], "CaseRecords"))


def read_solver_tables(paths: Mapping[str, str]) -> dict[str, list[dict[str, Any]]]:
    """Read the CSV files that a solver needs, as rows of plain numbers and text.

    Raises
    ------
    InputError
        For a file that is missing, is not a CSV table or has no rows.
    """
    return {name: _read_rows(name, path) for name, path in paths.items()}


def _read_rows(name: str, path: str) -> list[dict[str, Any]]:
    if not Path(path).is_file():
        raise InputError(
            "this table of a solver does not exist",
            "correct the path in the solver's options",
            file=path,
            column=name,
        )
    import pandas as pd  # not with the module: each case's process would import it

    try:
        rows = pd.read_csv(path, comment="#").to_dict("records")
    except (pd.errors.ParserError, pd.errors.EmptyDataError, UnicodeDecodeError) as error:
        raise InputError(
            f"this table of a solver is not a CSV table: {str(error).strip()}",
            "save it as CSV (UTF-8) with a header and as many values in every row, or correct the "
            "path in the solver's options",
            file=path,
            column=name,
        ) from error
    if not rows:
        raise InputError(
            "this table of a solver has no rows",
            "give a table with a header and values",
            file=path,
            column=name,
        )
    return [{str(key): value for key, value in row.items()} for row in rows]
