"""Solve one batch of cases of a study with one solver."""

from typing import Any

from nptcs.campaign.batch import solve_batch
from nptcs.campaign.record import RecordStore, write_records
from nptcs.campaign.tries import note_ends
from nptcs.config.root import read_config
from nptcs.console import clear_errors
from nptcs.files import read_model
from nptcs.tables.cases import Design
from nptcs.tables.io import read_table
from nptcs.tables.material_card import PlyCard


def solve(job: dict[str, Any], store: str, records: str, design: str, **more) -> None:
    constants = [read_model(file, PlyCard).values() for file in more.get("ply", [])]
    ply = constants[0] if constants else None
    # time limits and cache places are in the configuration alone: as params they would rerun it
    options = read_config(more["config"]).options_of(job["study"]["name"], job["solver"])
    granted = RecordStore(store), more["cores"], more["tokens"]
    job = {**job, "options": options}
    done = solve_batch(job, read_table(design, Design), ply, *granted)
    note_ends(records, done)
    write_records(records, done)


if __name__ == "__main__":
    granted = {"cores": snakemake.threads, "tokens": snakemake.resources.licence_tokens}
    with clear_errors(snakemake.log[0]):
        files = {**snakemake.params, **snakemake.input, **snakemake.output}
        solve(**files, **granted, config=snakemake.config)
