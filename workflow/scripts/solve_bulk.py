"""Solve the cases of a study as a table, with a solver that can."""

from typing import Any

from nptcs.campaign.bulk import solve_bulk
from nptcs.campaign.bulk_file import write_bulk
from nptcs.campaign.tries import try_again
from nptcs.config.root import read_config
from nptcs.console import clear_errors
from nptcs.files import read_model
from nptcs.tables.io import read_table
from nptcs.tables.laboratory.material_card import PlyCard
from nptcs.tables.tyres.cases import DesignTable


def solve(job: dict[str, Any], store: str, results: str, design: str, **more) -> None:
    ply = next((read_model(file, PlyCard).values() for file in more.get("ply", [])), None)
    options = read_config(more["config"]).options_of(job["study"]["name"], job["solver"])
    given = {**job, "options": options}, read_table(design, DesignTable), ply
    table, again = solve_bulk(*given, store, more["cores"], more["tokens"], more["log"])
    if again:
        try_again(results)
    write_bulk(results, table)


if __name__ == "__main__":
    granted = {"cores": snakemake.threads, "tokens": snakemake.resources.licence_tokens}
    granted |= {"config": snakemake.config, "log": snakemake.log[0]}
    with clear_errors(snakemake.log[0]):
        solve(**snakemake.params, **granted, **snakemake.input, **snakemake.output)
