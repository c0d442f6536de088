"""Gather what each solved tyre does: responses, load curve, stress of its plates."""

from typing import Any

from nptcs.campaign.record import read_records
from nptcs.config.studies.responses import TyreResponseSettings
from nptcs.console import clear_errors
from nptcs.responses.strength import ply_strengths
from nptcs.responses.table import plate_stress, tyre_curves, tyre_responses
from nptcs.tables.io import read_table, write_table
from nptcs.tables.laboratory.statistics import StatisticsTable
from nptcs.tables.tyres.tyre_responses import PlateStress, TyreCurves, TyreResponses


def gather(job: dict[str, Any], records: list[str], statistics: str, **out: str) -> None:
    settings = TyreResponseSettings.model_validate(job["settings"])
    strengths = ply_strengths(read_table(statistics, StatisticsTable), job["ply"])
    cases = read_records(records)
    write_table(out["responses"], tyre_responses(cases, settings, strengths), TyreResponses)
    write_table(out["curves"], tyre_curves(cases), TyreCurves)
    write_table(out["plates"], plate_stress(cases), PlateStress)


if __name__ == "__main__":
    with clear_errors(snakemake.log[0]):
        gather(**snakemake.params, **snakemake.input, **snakemake.output)
