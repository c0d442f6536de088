"""Compare each computed stiffness with the published one, and summarise the differences."""

from typing import Any

from nptcs.compare import published_stiffness as compare
from nptcs.compare.stiffness_exponents import stiffness_exponents
from nptcs.console import clear_errors
from nptcs.tables.io import check, read_table, write_table
from nptcs.tables.published import stiffness as contracts
from nptcs.tables.tyres.cases import Cases, DesignTable


def compare_published(job: dict[str, Any], cases: str, designs: list[str], **output: str) -> None:
    studies = {
        name: compare.Comparison(read_table(file, DesignTable), **facts)
        for (name, facts), file in zip(job["studies"].items(), designs, strict=True)
    }
    table = compare.compare_published(read_table(cases, Cases), studies)
    table = check(table, contracts.StiffnessAgainstPublished, output["table"])
    errors, levels = compare.stiffness_errors(table), compare.stiffness_by_level(table, studies)
    write_table(output["table"], table, contracts.StiffnessAgainstPublished)
    write_table(output["errors"], errors, contracts.StiffnessErrors)
    write_table(output["levels"], levels, contracts.StiffnessByLevel)
    exponents = stiffness_exponents(table, studies)
    write_table(output["exponents"], exponents, contracts.StiffnessExponents)


if __name__ == "__main__":
    with clear_errors(snakemake.log[0]):
        compare_published(**snakemake.params, **snakemake.input, **snakemake.output)
