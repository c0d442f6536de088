"""What the report and the workbook say about a table: sheet, title, file, rule, source, headings.

Result tables get their entry from `nptcs.tables.catalogue`; the others, which the report makes
itself from the sheet, the records and the material card, have theirs here.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace

import pandera.pandas as pa

from nptcs.language import tr
from nptcs.tables.result_table import PER_STUDY, Heading, ResultTable

SHEET_NAME_LENGTH = 31
"""Characters that the name of a sheet in a workbook can have."""


@dataclass(frozen=True)
class Entry:
    """One table.

    Parameters
    ----------
    sheet : str
        Name of its sheet in the workbook, 31 characters at most.
    title : str
        What it says.
    file : str
        Its file among the results, or the file that it is taken from.
    rule : str
        Snakemake rule that made it.
    source : str
        What the rule made it from, and how.
    headings : mapping of str to Heading
        Headings of columns whose names do not state the unit.
    contract : type of DataFrameModel, optional
        Contract of its columns, which says what they mean.
    factors : mapping of str to Heading
        How factors are written, in headings and in cells.
    """

    sheet: str
    title: str
    file: str
    rule: str
    source: str
    headings: Mapping[str, Heading] = field(default_factory=dict)
    contract: type[pa.DataFrameModel] | None = None
    factors: Mapping[str, Heading] = field(default_factory=dict)

    def with_factors(self, factors: Mapping[str, Heading]) -> Entry:
        """Return the same entry with the names that the configuration gives the factors."""
        return replace(self, headings={**factors, **self.headings}, factors=factors)

    def with_headings(self, headings: Mapping[str, Heading]) -> Entry:
        """Return the same entry for a view of the table that has other columns."""
        return replace(self, headings={**self.headings, **headings})


def result_entry(file: str, table: ResultTable, study: str = "") -> Entry:
    """Return the entry of a table of ``results/tables``, as the catalogue's row says."""
    sheet = table.sheet.replace(PER_STUDY, study) or file.removesuffix(".csv")
    return Entry(
        sheet[:SHEET_NAME_LENGTH],
        tr(table.title).replace(PER_STUDY, study),
        f"results/tables/{file}",
        table.rule,
        table.source,
        table.headings,
        table.contract,
    )


SHEET = Entry(
    "specimen_sheet",
    "Specimen sheet: what the laboratory states of each specimen",
    "the specimen sheet of the configuration",
    "(input)",
    "what the laboratory wrote; the area is mean width × mean thickness",
)
CONDITIONING = Entry(
    "conditioning",
    "How each curve came about: strain source, conditioning, flags",
    "results/1_ingest/*.json",
    "ingest",
    "raw files, format profiles and the section `ingest` of the configuration",
)
PLY = Entry(
    "ply_constants",
    "Constants of the orthotropic ply",
    "results/material_card.json",
    "calibrate_ply, material_card",
    "the specimens in each row by the rule in each row; assumptions from the configuration",
)
RUBBERS = Entry(
    "rubber_constants",
    "Hyperelastic constants of the rubbers",
    "results/material_card.json",
    "calibrate_rubber, material_card",
    "the specimens in each row, within the strain range in each row",
    {
        "strain_low": Heading("strain range from", "1"),
        "strain_high": Heading("strain range to", "1"),
    },
)
SOFTWARE = Entry(
    "software",
    "Software that built the report",
    "(the environment)",
    "report",
    "installed versions",
)
INPUTS = Entry(
    "published_inputs",
    "Published and configured input files with their SHA-256",
    "(the files named)",
    "report",
    "files that the configuration names; raw laboratory files are in the table `files`",
)


def design_entry(study: str) -> Entry:
    """Return the entry of a study's design table."""
    return Entry(
        f"design_{study}"[:SHEET_NAME_LENGTH],
        tr("Design table of the study {study}", study=study),
        f"results/4_design/{study}.csv",
        "design",
        "factors, levels and kind of design in the configuration",
    )
