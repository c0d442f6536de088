"""Write the workbook."""

from typing import Any

from nptcs.console import clear_errors
from nptcs.files import atomic_path
from nptcs.report.data import read_results
from nptcs.report.stale import stale_name
from nptcs.report.workbook.build import build_workbook


def write(job: dict[str, Any], workbook: str, **files: Any) -> None:
    results = read_results(job, files)
    with atomic_path(workbook) as temporary:
        temporary.write_bytes(build_workbook(results))
    stale_name(workbook).unlink(missing_ok=True)


if __name__ == "__main__":
    with clear_errors(snakemake.log[0]):
        write(**snakemake.params, **snakemake.input, **snakemake.output)
