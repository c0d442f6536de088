"""Set each computed stiffness beside the published one, and sum the differences up."""

from collections.abc import Sequence
from typing import Any

from nptcs.compare.published_stiffness import (
    Comparison,
    compare_published,
    stiffness_by_level,
    stiffness_errors,
)
from nptcs.console import clear_errors
from nptcs.tables.cases import Cases, Design
from nptcs.tables.io import check, read_table, write_table
from nptcs.tables.published_stiffness import (
    StiffnessAgainstPublished,
    StiffnessByLevel,
    StiffnessErrors,
)


def compare(
    job: dict[str, Any], cases: str, designs: Sequence[str], output: dict[str, str]
) -> None:
    studies = {
        name: Comparison(
            read_table(file, Design),
            tuple(facts["factors"]),
            tuple(facts["solvers"]),
            facts["calibration_cases"],
        )
        for (name, facts), file in zip(job["studies"].items(), designs, strict=True)
    }
    table = compare_published(read_table(cases, Cases), studies)
    table = check(table, StiffnessAgainstPublished, output["table"])
    write_table(output["table"], table, StiffnessAgainstPublished)
    write_table(output["errors"], stiffness_errors(table), StiffnessErrors)
    write_table(output["levels"], stiffness_by_level(table, studies), StiffnessByLevel)


if __name__ == "__main__":
    with clear_errors(snakemake.log[0]):
        compare(
            snakemake.params.job,
            snakemake.input.cases,
            snakemake.input.get("designs", []),
            dict(snakemake.output.items()),
        )
