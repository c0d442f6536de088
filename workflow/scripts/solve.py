"""Solve one batch of cases of a study with one solver."""

from typing import Any

from nptcs.campaign.batch import solve_batch
from nptcs.campaign.record import RecordStore, write_records
from nptcs.campaign.tries import note_ends
from nptcs.config.root import read_config
from nptcs.console import clear_errors
from nptcs.files import read_model
from nptcs.tables.io import read_table
from nptcs.tables.laboratory.material_card import PlyCard
from nptcs.tables.tyres.cases import DesignTable


def solve(job: dict[str, Any], store: str, records: str, design: str, **more) -> None:
    ply = next((read_model(file, PlyCard).values() for file in more.get("ply", [])), None)
    # time limits and cache places are in the configuration alone: as params they would rerun it
    options = read_config(more["config"]).options_of(job["study"]["name"], job["solver"])
    given = {**job, "options": options}, read_table(design, DesignTable), ply
    done = solve_batch(*given, RecordStore(store), more["cores"], more["tokens"], more["log"])
    note_ends(records, done)
    write_records(records, done)


if __name__ == "__main__":
    granted = {"cores": snakemake.threads, "tokens": snakemake.resources.licence_tokens}
    granted |= {"config": snakemake.config, "log": snakemake.log[0]}
    with clear_errors(snakemake.log[0]):
        solve(**snakemake.params, **granted, **snakemake.input, **snakemake.output)
