"""Write the report: one HTML page."""

from typing import Any

from nptcs.console import clear_errors
from nptcs.files import write_text
from nptcs.report.data import read_results
from nptcs.report.html import render_report
from nptcs.report.plots import kept_figures
from nptcs.report.stale import stale_name


def report(job: dict[str, Any], page: str, drawers: int, **files: Any) -> None:
    results = read_results(job, files)
    with kept_figures(job["figures"], job["figure_code"], drawers):
        write_text(page, render_report(results))
    stale_name(page).unlink(missing_ok=True)


if __name__ == "__main__":
    with clear_errors(snakemake.log[0]):
        granted = {"drawers": snakemake.resources.drawers}
        report(**snakemake.params, **granted, **snakemake.input, **snakemake.output)
