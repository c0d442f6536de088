"""Solve one batch of cases of a study with one solver."""

import sys
from pathlib import Path
from typing import Any

from nptcs.campaign.jobs import make_jobs
from nptcs.campaign.record import CaseRecord, RecordStore, write_records
from nptcs.campaign.runner import run_cases
from nptcs.campaign.schedule import cases_side_by_side
from nptcs.config.study import Study
from nptcs.config.tyre import TyreGeometry
from nptcs.console import clear_errors
from nptcs.solvers.registry import load, module_of, read_options
from nptcs.tables.cases import Design
from nptcs.tables.io import read_table
from nptcs.tables.material_card import PlyCard


def report_progress(record: CaseRecord, reused: bool, done: int, total: int) -> None:
    how = "known" if reused else f"{record.wall_time_s:.2f} s"
    status, message = record.result.status.value, record.result.message
    why = "" if status == "ok" else f": {message}"
    print(
        f"{record.study}/{record.solver} {done}/{total} {record.case_id} {status} ({how}){why}",
        file=sys.stderr,
        flush=True,
    )


def solve(
    job: dict[str, Any],
    design: str,
    ply: str | None,
    store: str,
    cores: int,
    tokens: int,
    records: str,
) -> None:
    cases = read_table(design, Design).iloc[job["batch"] - 1 :: job["batches"]]
    constants = PlyCard.model_validate_json(Path(ply).read_text("utf-8")).values() if ply else None
    jobs = make_jobs(
        Study.model_validate(job["study"]),
        job["solver"],
        job["options"],
        TyreGeometry.model_validate(job["tyre"]),
        cases,
        constants,
    )
    options = read_options(load(module_of(job["solver"], job["options"])), job["options"])
    at_a_time = cases_side_by_side(cores, tokens, options)
    write_records(records, run_cases(jobs, RecordStore(store), at_a_time, report_progress))


if __name__ == "__main__":
    with clear_errors(snakemake.log[0]):
        solve(
            snakemake.params.job,
            snakemake.input.design,
            next(iter(snakemake.input.get("ply", [])), None),
            snakemake.params.store,
            snakemake.threads,
            snakemake.resources.licence_tokens,
            snakemake.output.records,
        )
