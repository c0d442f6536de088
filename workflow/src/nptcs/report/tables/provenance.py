"""Input files, software and configuration as tables and text."""

from __future__ import annotations

import pandas as pd
import yaml

from nptcs.language import tr
from nptcs.report.data import Results
from nptcs.report.tables.entries import Entry
from nptcs.tables.tyres.cases import Cases


def entries_table(entries: list[Entry]) -> pd.DataFrame:
    """Write the catalogue as a table, one row per table."""
    rows = [(e.sheet, tr(e.title), tr(e.file), e.rule, tr(e.source)) for e in entries]
    return pd.DataFrame(rows, columns=["sheet", "what_it_says", "file", "rule", "made_from"])


def inputs_table(results: Results) -> pd.DataFrame:
    """List the configured input files with their SHA-256."""
    return pd.DataFrame(results.inputs.items(), columns=["file", "sha256"])


def software_table(results: Results) -> pd.DataFrame:
    """List the versions of the software and of the solvers that the cases name."""
    solvers = results.table(Cases).drop_duplicates(["solver", "solver_version"])
    rows = list(results.software.items())
    rows += [
        (tr("solver {solver}", solver=row.solver), str(row.solver_version))
        for row in solvers.itertuples()
    ]
    return pd.DataFrame(rows, columns=["software", "version"])


def configuration_text(results: Results) -> str:
    """Write the configuration as YAML."""
    return yaml.safe_dump(
        results.config.model_dump(mode="json"), sort_keys=False, allow_unicode=True, width=100
    )
