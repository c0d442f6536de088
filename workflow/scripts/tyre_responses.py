"""Gather what each solved tyre does: responses, load curve, stress of its plates."""

from typing import Any

from nptcs.campaign.record import read_records
from nptcs.config.responses import TyreResponseSettings
from nptcs.console import clear_errors
from nptcs.responses.strength import PlyStrengths, ply_strengths
from nptcs.responses.table import plate_stress, tyre_curves, tyre_responses
from nptcs.tables.io import read_table, write_table
from nptcs.tables.statistics import StatisticsTable
from nptcs.tables.tyre_responses import PlateStress, TyreCurves, TyreResponses


def gather(job: dict[str, Any], files: list[str], statistics: str, out: dict[str, str]) -> None:
    records = read_records(files)
    settings = TyreResponseSettings.model_validate(job["settings"])
    table = read_table(statistics, StatisticsTable)
    strengths = ply_strengths(table, job["ply"]) if job["ply"] else PlyStrengths()
    responses = tyre_responses(records, settings, strengths)
    write_table(out["responses"], responses, TyreResponses)
    write_table(out["curves"], tyre_curves(records), TyreCurves)
    write_table(out["plates"], plate_stress(records), PlateStress)


if __name__ == "__main__":
    with clear_errors(snakemake.log[0]):
        given = snakemake.input
        files = list(given.get("records", []))
        gather(snakemake.params.job, files, given.statistics, dict(snakemake.output.items()))
