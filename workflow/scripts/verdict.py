"""Say whether everything gave a result; end the run with exit status 1 if not."""

import sys
from pathlib import Path
from typing import Any

from nptcs.console import clear_errors
from nptcs.files import write_text
from nptcs.report.verdict import verdict
from nptcs.tables.cases import Cases
from nptcs.tables.curves import IngestRecord
from nptcs.tables.io import read_table
from nptcs.tables.problems import Problems
from nptcs.tables.specimens import Specimen


def judge(job: dict[str, Any], source: dict[str, Any]) -> tuple[bool, str]:
    problems = read_table(source["problems"], Problems)
    read = [IngestRecord.model_validate_json(Path(f).read_text("utf-8")) for f in source["records"]]
    sheet = [Specimen.model_validate(row) for row in job["specimens"]]
    by_name = {record.specimen: record for record in read}
    sound, line = verdict(problems, read_table(source["cases"], Cases), sheet, by_name)
    for row in problems.itertuples():
        print(f"{row.stage} {row.name} {row.solver} {row.status}: {row.message}", file=sys.stderr)
    print(line, file=sys.stderr)
    return sound, line


if __name__ == "__main__":
    with clear_errors(snakemake.log[0]):
        sound, line = judge(snakemake.params.job, dict(snakemake.input.items()))
        if not sound:
            sys.exit(1)
        write_text(snakemake.output.verdict, line + "\n")
