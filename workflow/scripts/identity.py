"""Give the run its identity: a hash of inputs, configuration, code and tables."""

from collections.abc import Sequence
from datetime import UTC, datetime
from typing import Any

from nptcs.console import clear_errors
from nptcs.files import write_model
from nptcs.runs.content import inputs_of_run, tables_of_run
from nptcs.runs.identity import identify
from nptcs.runs.software import software_versions


def name_run(
    job: dict[str, Any], tables: Sequence[str], card: str, identity: str, inputs: Sequence[str]
) -> None:
    inputs_read = inputs_of_run(job["folder"], tables, job["inputs"])
    hashed = tables_of_run(tables, card)
    code, software, now = job["code_of_tables"], software_versions(), datetime.now(UTC)
    write_model(identity, identify(inputs_read, job["config"], code, hashed, software, now))


if __name__ == "__main__":
    with clear_errors(snakemake.log[0]):
        name_run(**snakemake.params, **snakemake.input, **snakemake.output)
