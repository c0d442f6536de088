"""Say what became of every file in the laboratory's folder."""

from collections.abc import Sequence
from typing import Any

from nptcs.console import clear_errors
from nptcs.files import read_model
from nptcs.ingest.account import account_for_files
from nptcs.tables.io import write_table
from nptcs.tables.laboratory.curves import IngestRecord
from nptcs.tables.laboratory.files import Files


def account(job: dict[str, Any], sheet: str, records: Sequence[str], files: str) -> None:
    read = [read_model(file, IngestRecord) for file in records]
    write_table(files, account_for_files(sheet, read), Files)


if __name__ == "__main__":
    with clear_errors(snakemake.log[0]):
        account(**snakemake.params, **snakemake.input, **snakemake.output)
