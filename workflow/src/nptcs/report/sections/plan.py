"""Which function builds which section, and which further tables a section shows."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace

import pandera.pandas as pa

from nptcs.language import tr, tr_count
from nptcs.report.blocks import MoreTables, PageBlock, Section, TableView, Text
from nptcs.report.data import Results
from nptcs.report.sections.decision import decision_section
from nptcs.report.sections.explorer import explorer_section
from nptcs.report.sections.lca import lca_section
from nptcs.report.sections.materials import materials_section
from nptcs.report.sections.provenance import provenance_section
from nptcs.report.sections.specimens import specimens_section
from nptcs.report.sections.spokes import spoke_section
from nptcs.report.sections.stiffness.published import published_stiffness_section
from nptcs.report.sections.studies import (
    cases_section,
    design_section,
    sensitivity_section,
    surfaces_section,
)
from nptcs.report.sections.tyre import tyre_section
from nptcs.report.sections.uncertainty import uncertainty_section
from nptcs.report.table_view import sheet_view
from nptcs.report.tables.sheets import Sheet, Sheets
from nptcs.tables.published.lca_validation import LcaNeutralLine
from nptcs.tables.result_table import ReportSection
from nptcs.tables.tyres.deformed_tyre import DeformedTyre
from nptcs.tables.tyres.neutral_line import NeutralLine
from nptcs.tables.tyres.spoke_stiffness import SpokeCurves
from nptcs.tables.tyres.tyre_responses import PlateStress, TyreCurves

MOST_ROWS = 500
"""Rows beyond which the page names a table instead of printing it."""


MOST_OPEN_ROWS = 6
"""Rows of the longest table that is open next to figures and text."""


def further_section(results: Results, sheets: Sheets) -> Section:
    """Return the empty section for tables that no other section claims."""
    return Section(ReportSection.FURTHER, tr("Further tables"), ())


@dataclass(frozen=True)
class SectionPlan:
    """How a section is built.

    Parameters
    ----------
    build : callable
        ``(results, sheets) → Section``.
    drawn : tuple of DataFrameModel types
        Result tables that it shows as figures only.
    """

    build: Callable[[Results, Sheets], Section]
    drawn: tuple[type[pa.DataFrameModel], ...] = ()


PLANS: Mapping[ReportSection, SectionPlan] = {
    # after the first screen: a place to try out designs, then the results, then their basis
    ReportSection.EXPLORE: SectionPlan(explorer_section),
    ReportSection.DECISION: SectionPlan(decision_section),
    ReportSection.UNCERTAINTY: SectionPlan(uncertainty_section),
    ReportSection.SENSITIVITY: SectionPlan(sensitivity_section),
    ReportSection.TYRE: SectionPlan(tyre_section, (TyreCurves, PlateStress, DeformedTyre)),
    ReportSection.PUBLISHED_STIFFNESS: SectionPlan(published_stiffness_section, (NeutralLine,)),
    ReportSection.LCA: SectionPlan(lca_section, (LcaNeutralLine,)),
    ReportSection.SPOKE: SectionPlan(spoke_section, (SpokeCurves,)),
    ReportSection.SURFACES: SectionPlan(surfaces_section),
    ReportSection.MATERIALS: SectionPlan(materials_section),
    ReportSection.SPECIMENS: SectionPlan(specimens_section),
    ReportSection.DESIGN: SectionPlan(design_section),
    ReportSection.CASES: SectionPlan(cases_section),
    ReportSection.FURTHER: SectionPlan(further_section),
    ReportSection.PROVENANCE: SectionPlan(provenance_section),
}
"""All sections in reading order; `ReportSection.SUMMARY` comes before them."""


def build_sections(results: Results, sheets: Sheets) -> list[Section]:
    """Build all sections; a section without content is left out.

    A result table with rows that belongs to a section and that the section neither shows nor
    draws is added at its end, folded where the section has something to say before it.
    """
    sections = []
    for name, plan in PLANS.items():
        section = plan.build(results, sheets)
        shown = {block.entry.file for block in section.blocks if isinstance(block, TableView)}
        rest = [
            sheet
            for sheet in sheets.values()
            if sheet.section is name
            and len(sheet.table)
            and sheet.entry.file not in shown
            and sheet.entry.contract not in plan.drawn
        ]
        if section.blocks or rest:
            blocks = (
                *folded_blocks(section.blocks),
                *_further_tables(rest, folded=bool(section.blocks)),
            )
            sections.append(replace(section, blocks=blocks))
    return sections


def folded_blocks(blocks: Sequence[PageBlock]) -> list[PageBlock]:
    """Fold the long tables of a section that has something else to show."""
    if all(isinstance(block, TableView) for block in blocks):
        return list(blocks)
    return [
        replace(block, folded=True)
        if isinstance(block, TableView) and len(block.rows) > MOST_OPEN_ROWS
        else block
        for block in blocks
    ]


def _further_tables(sheets: Sequence[Sheet], *, folded: bool) -> tuple[PageBlock, ...]:
    """Show tables, or fold them under a line that names them."""
    tables = tuple(map(_shown, sheets))
    if not folded or not tables:
        return tables
    titles = "; ".join(tr(sheet.entry.title) for sheet in sheets)
    title = tr_count("{count} more table", "{count} more tables", len(tables))
    return (MoreTables(title, titles, tables),)


def _shown(sheet: Sheet) -> TableView | Text:
    """Show a table, or say where it is if it is too long for a page."""
    if len(sheet.table) <= MOST_ROWS:
        return sheet_view(sheet)
    place = (
        tr(" and in the sheet {sheet} of the workbook", sheet=sheet.entry.sheet)
        if sheet.in_workbook
        else ""
    )
    return Text(
        tr(
            "{title}: {count:,} rows, in {file}{place}.",
            title=tr(sheet.entry.title),
            count=len(sheet.table),
            file=sheet.entry.file,
            place=place,
        )
    )
