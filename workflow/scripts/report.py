"""Write the report: the HTML page and the workbook."""

from typing import Any

from nptcs.console import clear_errors
from nptcs.files import atomic_path, write_text
from nptcs.report.data import read_results
from nptcs.report.html import render_report
from nptcs.report.plots import kept_figures
from nptcs.report.stale import stale_name
from nptcs.report.workbook.build import build_workbook


def report(job: dict[str, Any], page: str, workbook: str, **files: Any) -> None:
    results = read_results(job, files)
    with atomic_path(workbook) as temporary:
        temporary.write_bytes(build_workbook(results))
    with kept_figures(job["figures"]):
        write_text(page, render_report(results))
    for file in (page, workbook):
        stale_name(file).unlink(missing_ok=True)


if __name__ == "__main__":
    with clear_errors(snakemake.log[0]):
        report(**snakemake.params, **snakemake.input, **snakemake.output)
