"""Collect everything that gave no result: sheet rows, specimens, cases, fits."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import pandas as pd

from nptcs.console import clear_errors
from nptcs.tables.cases import Cases
from nptcs.tables.curves import IngestRecord
from nptcs.tables.io import read_table, write_table
from nptcs.tables.problems import Problems, problems_table


def collect(
    job: dict[str, Any], records: Sequence[str], cases: str, tables: Sequence[str]
) -> pd.DataFrame:
    rows = [("sheet", name, "", "error", message) for name, message in job["sheet_errors"]]
    for file in records:
        record = IngestRecord.model_validate_json(Path(file).read_text("utf-8"))
        if record.status != "ok":
            rows.append(("ingest", record.specimen, "", record.status, record.message))
    for case in read_table(cases, Cases).to_dict("records"):
        if case["status"] != "ok":
            rows.append(("solve", case["case_id"], case["solver"], case["status"], case["message"]))
    found = [problems_table(rows), *(read_table(file, Problems) for file in tables)]
    return pd.concat(found, ignore_index=True)


if __name__ == "__main__":
    with clear_errors(snakemake.log[0]):
        source = snakemake.input
        table = collect(snakemake.params.job, source.records, source.cases, source.tables)
        write_table(snakemake.output.problems, table, Problems)
