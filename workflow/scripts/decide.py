"""Answer the decisions, confirm them, and assess the uncertainty of reference and choice."""

from pathlib import Path
from typing import Any

from nptcs.config.root import read_config
from nptcs.console import clear_errors
from nptcs.decisions.run import answer_all, read_run
from nptcs.decisions.tables import decision_tables
from nptcs.tables import decisions as contracts
from nptcs.tables.io import write_table
from nptcs.tables.problems import Problems
from nptcs.tables.uncertainty import ResponseUncertainty, UncertaintyShares
from nptcs.uncertainty.tables import uncertainty_tables


def decide(job: dict[str, Any], store: str, models: list[str], **files: Any) -> None:
    run = read_run(read_config(files["config"]), files, models, Path(job["added"]))
    done = answer_all(run, Path(store), files["cores"])
    assessed, found = uncertainty_tables(done.designs, run.errors), decision_tables(done.answers)
    write_table(files["uncertainty"], assessed.responses, ResponseUncertainty)
    write_table(files["shares"], assessed.shares, UncertaintyShares)
    write_table(files["decisions"], found.decisions, contracts.Decisions)
    write_table(files["designs"], found.designs, contracts.DecisionDesigns)
    write_table(files["front"], found.front, contracts.DecisionFront)
    write_table(files["confirmation"], found.confirmation, contracts.DecisionConfirmation)
    write_table(files["problems"], done.problems, Problems)


if __name__ == "__main__":
    granted = {"config": snakemake.config, "cores": snakemake.threads}
    with clear_errors(snakemake.log[0]):
        decide(**snakemake.params, **granted, **snakemake.input, **snakemake.output)
