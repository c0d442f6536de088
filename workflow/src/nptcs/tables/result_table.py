"""What the catalogue says about a result table, as plain data for the report and the workbook."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import StrEnum

import pandera.pandas as pa

PER_STUDY = "STUDY"
"""Placeholder in file names and titles for the name of each study that has a surface."""


@dataclass(frozen=True)
class Heading:
    """Name and unit of a column; the unit is empty where it has none or a row states it."""

    name: str
    unit: str = ""

    def __str__(self) -> str:
        return f"{self.name} [{self.unit}]" if self.unit else self.name


class ReportSection(StrEnum):
    """Sections of the report, in reading order; the value is the anchor on the page."""

    SUMMARY = "verdict"
    EXPLORE = "explore"
    DECISION = "decision"
    UNCERTAINTY = "uncertainty"
    SENSITIVITY = "sensitivity"
    TYRE = "tyre"
    PUBLISHED_STIFFNESS = "published_stiffness"
    LCA = "lca"
    SPOKE = "spoke"
    SURFACES = "surfaces"
    MATERIALS = "materials"
    SPECIMENS = "specimens"
    DESIGN = "design"
    CASES = "cases"
    FURTHER = "further"
    PROVENANCE = "provenance"


class RowMark(StrEnum):
    """Which rows of a table are marked, and by what."""

    NONE = "none"
    EVERY_ROW = "every row failed"
    STATUS = "status is not ok"
    STATUS_OR_CALIBRATION = "status is not ok, or used for calibration"
    FILE_STATUS = "status of a laboratory file"
    INCLUDE = "left out by the sheet"
    SPECIMEN = "specimen left out, or property not assessed"
    OUTLIERS = "group with an outlier"
    ORIGIN = "assumed, not measured"
    DEVIATION = "deviation from a standard"


class SyntheticBy(StrEnum):
    """What makes a table synthetic."""

    NOTHING = "nothing: it rests on published data, or lists what went wrong"
    SPECIMENS = "any specimen of the sheet"
    PLIES = "the ply's specimens"
    RUBBERS = "the rubbers' specimens"
    STUDIES = "any study; a table of one study by that study"
    ROWS = "the study and the solver in each row"


@dataclass(frozen=True)
class ResultTable:
    """One row of the catalogue: everything about a table besides its contract.

    Parameters
    ----------
    contract : type of DataFrameModel
        Its columns; a contract belongs to one table.
    title : str
        What it says.
    rule : str
        Snakemake rules that made it.
    source : str
        What the rules made it from, and how.
    section : ReportSection
        Section of the report that shows it.
    headings : mapping of str to Heading
        Headings of columns whose names do not state the unit.
    mark : RowMark
        Which rows are marked.
    synthetic : SyntheticBy
        What makes it synthetic.
    sheet : str
        Name of its sheet in the workbook, if not that of its file; `PER_STUDY` as there.
    raw : bool
        Whether it contains curves, shapes or fields point by point: a CSV file next to the
        workbook, which draws what matters of it.
    """

    contract: type[pa.DataFrameModel]
    title: str
    rule: str
    source: str
    section: ReportSection = ReportSection.FURTHER
    headings: Mapping[str, Heading] = field(default_factory=dict)
    mark: RowMark = RowMark.NONE
    synthetic: SyntheticBy = SyntheticBy.SPECIMENS
    sheet: str = ""
    raw: bool = False
