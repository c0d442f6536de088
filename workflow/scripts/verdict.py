"""Say whether everything gave a result; end the run with exit status 1 if not."""

import sys
from typing import Any

from nptcs.console import clear_errors
from nptcs.files import read_model, write_text
from nptcs.report.verdict import problem_lines, verdict
from nptcs.tables.io import read_table
from nptcs.tables.laboratory.curves import IngestRecord
from nptcs.tables.laboratory.specimens import Specimen
from nptcs.tables.problems import Problems
from nptcs.tables.tyres.cases import Cases


def judge(job: dict[str, Any], records: list[str], verdict_file: str, **tables: str) -> None:
    problems = read_table(tables["problems"], Problems)
    outcomes = [read_model(file, IngestRecord) for file in records]
    by_name = {record.specimen: record for record in outcomes}
    sheet = [Specimen.model_validate(row) for row in job["specimens"]]
    sound, line = verdict(problems, read_table(tables["cases"], Cases), sheet, by_name)
    print(*problem_lines(problems), line, sep="\n", file=sys.stderr)
    if not sound:
        sys.exit(1)
    write_text(verdict_file, line + "\n")


if __name__ == "__main__":
    with clear_errors(snakemake.log[0]):
        judge(**snakemake.params, **snakemake.input, **snakemake.output)
