"""The first sheet: the answer of the run from its tables, and an index with links."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import PurePosixPath

import pandas as pd
from openpyxl.styles import Font
from openpyxl.utils import get_column_letter
from openpyxl.worksheet.hyperlink import Hyperlink
from openpyxl.worksheet.worksheet import Worksheet

from nptcs.report.cover import cover_lines
from nptcs.report.data import Results
from nptcs.report.sections.summary import findings
from nptcs.report.tables.sheets import Sheet
from nptcs.report.workbook.cells import (
    FILLS,
    FONT,
    LINK,
    SYNTHETIC,
    WRAPPED,
    head_row,
    write,
    write_row,
)
from nptcs.report.workbook.layout import fit_heights, page_for_print
from nptcs.report.workbook.number_formats import format_of_number
from nptcs.tables.analysis.decisions import DecisionConfirmation, Decisions
from nptcs.tables.analysis.uncertainty import ResponseUncertainty
from nptcs.tables.published.stiffness import StiffnessErrors

TITLE = "Summary"
FINDING_HEAD = ("question", "answer", "", "", "", "", "in words", "table")
ANSWER_HEAD = ("number", "in words", "value", "from", "to", "unit", "what it rests on", "table")
INDEX_HEAD = ("sheet", "what it says", "rows", "synthetic", "", "rule", "made from", "file")
WIDTHS = (34, 66, 12, 12, 12, 24, 66, 40)
REFERENCE = "reference"


@dataclass(frozen=True)
class Answer:
    """One line of the answer; numbers stay numbers, and `table` names where they are from."""

    question: str
    answer: str
    table: str
    value: float | None = None
    low: float | None = None
    high: float | None = None
    unit: str = ""
    basis: str = ""


@dataclass(frozen=True)
class IndexRow:
    """One row of the index: a sheet of this workbook, or a file next to it."""

    name: str
    says: str
    rows: int | None = None
    synthetic: bool | None = None
    file: str = ""
    source: str = ""
    rule: str = ""
    here: bool = True


def answers(results: Results) -> list[Answer]:
    """Collect the numbers behind the findings, as numbers, from the tables of a run."""
    return [
        *_stiffness(results),
        *_decisions(results),
        *_trust(results),
    ]


def _stiffness(results: Results) -> Iterator[Answer]:
    table = results.table(ResponseUncertainty)
    rows = table[(table["design"] == REFERENCE) & (table["response"] == "secant_stiffness")]
    for row in rows.to_dict("records"):
        yield Answer(
            f"Stiffness of the reference design at {row['at']}",
            f"{row['mean']:.4g} ± {row['sd']:.2g} {row['unit']} (mean ± standard deviation) at "
            f"{row['factors']}",
            "uncertainty.csv",
            row["mean"],
            row["low"],
            row["high"],
            row["unit"],
            f"study {row['study']}, solver {row['solver']}, {row['surface']}, {row['cases']} "
            f"cases; {row['confidence_percent']:g} % interval",
        )


def _decisions(results: Results) -> Iterator[Answer]:
    confirmed = results.table(DecisionConfirmation)
    for row in results.table(Decisions).to_dict("records"):
        words = {"feasible": "", "infeasible": "no design meets it; nearest: "}
        answer = words.get(row["status"], "refused: ") + (row["design"] or row["message"])
        yield Answer(
            f"Design for: {row['goals']}",
            answer,
            "decisions.csv",
            row["probability"],
            None,
            None,
            "probability",
            f"study {row['study']}, solver {row['solver']}; asked for "
            f"{row['with_probability']:g}; confirmation: {row['confirmation'] or 'none'}",
        )
        for one in confirmed[confirmed["decision"] == row["decision"]].to_dict("records"):
            yield Answer(
                f"Confirmation, round {one['round']}: {one['response']} {one['at']}".rstrip(),
                f"solved {_text(one['solved'])}, predicted {_text(one['predicted'])}: "
                f"{one['result']}",
                "decision_confirmation.csv",
                one["solved"],
                one["low"],
                one["high"],
                one["unit"],
                "from and to: prediction interval of the surface",
            )


def _trust(results: Results) -> Iterator[Answer]:
    for row in results.table(StiffnessErrors).to_dict("records"):
        if row["group"] == "blind" and row["compared"]:
            yield Answer(
                f"Difference from the published stiffness ({row['study']}, {row['solver']})",
                f"mean {row['mean_percent']:+.2f} %, largest {row['largest_percent']:+.2f} % in "
                f"case {row['largest_case_id']}",
                "stiffness_errors.csv",
                row["mean_absolute_percent"],
                None,
                None,
                "%",
                f"{row['compared']} blind cases; value: mean absolute difference",
            )
    synthetic = [s.specimen for s in results.sheet if s.origin == "synthetic"]
    if synthetic:
        yield Answer(
            "Origin of the data",
            f"{len(synthetic)} of {len(results.sheet)} specimens are SYNTHETIC example data; "
            "sheets with an orange header rest on them",
            "specimens.csv",
        )


def _text(value: float) -> str:
    return "no value" if pd.isna(value) else f"{value:.6g}"


def write_summary(worksheet: Worksheet, results: Results, index: Sequence[IndexRow]) -> None:
    """Write the first sheet: what the run is, its answer, and what each sheet is."""
    worksheet.title = TITLE
    row = _write_head(worksheet, results)
    first = row + 1
    row = _write_findings(worksheet, first, results)
    row = _write_answers(worksheet, row + 1, results)
    _write_index(worksheet, row + 1, index)
    for column, width in enumerate(WIDTHS, start=1):
        worksheet.column_dimensions[get_column_letter(column)].width = width
    fit_heights(worksheet, first, worksheet.max_row)
    page_for_print(worksheet, None)


def _write_head(worksheet: Worksheet, results: Results) -> int:
    """Write title, verdict and identity; return the row after them."""
    sound, line = results.verdict()
    settings, identity = results.config.report, results.identity
    laboratory = results.config.laboratory
    lines = [settings.title, laboratory.name, *laboratory.address.splitlines()]
    lines += [f"{name}: {text}" for name, text in cover_lines(laboratory)]
    lines.append(line)
    if identity is not None:
        lines.append(f"Run {identity.short}, tables complete {identity.made_text}")
    if results.any_synthetic:
        lines.append("SYNTHETIC example data: sheets with an orange header rest on it.")
    lines.append(
        "Rows: red failed, yellow flagged, grey left out, assumed or calibrated on. "
        "Units: in brackets. Point at a heading to see what it means, its rule and its range."
    )
    for row, text in enumerate(filter(None, lines), start=1):
        cell = worksheet.cell(row, 1)
        write(cell, text)
        cell.font = Font(name=FONT, bold=row == 1 or text == line, size=14 if row == 1 else 11)
        if text == line and not sound:
            cell.fill = FILLS["bad"]
        if text.startswith("SYNTHETIC"):
            cell.fill = SYNTHETIC
    return worksheet.max_row + 1


def _write_findings(worksheet: Worksheet, top: int, results: Results) -> int:
    """Write the findings of the report's first screen; return the row after them."""
    head_row(worksheet, top, FINDING_HEAD)
    for row, one in enumerate(findings(results), start=top + 1):
        badge = " (SYNTHETIC DATA)" if one.synthetic else ""
        known = [one.question, one.answer + badge, None, None, None, None, one.words, one.source]
        write_row(worksheet, row, known)
        for column in range(1, len(FINDING_HEAD) + 1):
            worksheet.cell(row, column).alignment = WRAPPED
        worksheet.cell(row, 2).font = Font(name=FONT, bold=True)
        if one.synthetic:
            worksheet.cell(row, 2).fill = SYNTHETIC
    return worksheet.max_row + 1


def _write_answers(worksheet: Worksheet, top: int, results: Results) -> int:
    """Write the answers; return the row after them."""
    head_row(worksheet, top, ANSWER_HEAD)
    for row, one in enumerate(answers(results), start=top + 1):
        known = (one.question, one.answer, one.value, one.low, one.high, one.unit, one.basis)
        write_row(worksheet, row, [*known, one.table])
        for column in (3, 4, 5):
            cell = worksheet.cell(row, column)
            if cell.data_type == "n" and cell.value is not None:
                cell.number_format = format_of_number(float(cell.value))
        for column in range(1, len(ANSWER_HEAD) + 1):
            worksheet.cell(row, column).alignment = WRAPPED
    return worksheet.max_row + 1


def _write_index(worksheet: Worksheet, top: int, index: Sequence[IndexRow]) -> None:
    head_row(worksheet, top, INDEX_HEAD)
    for row, one in enumerate(index, start=top + 1):
        synthetic = None if one.synthetic is None else "yes" if one.synthetic else "no"
        known = [one.name, one.says, one.rows, synthetic, None, one.rule, one.source, one.file]
        write_row(worksheet, row, known)
        cell = worksheet.cell(row, 1)
        if one.here:
            cell.hyperlink = Hyperlink(ref=cell.coordinate, location=f"'{one.name}'!A1")
        else:
            cell.hyperlink = beside(one.file)
        cell.font = LINK
        for column in range(1, len(INDEX_HEAD) + 1):
            worksheet.cell(row, column).alignment = WRAPPED


def beside(file: str) -> str:
    """Return the address of a result next to the workbook, which is in ``results``.

    Examples
    --------
    >>> beside("results/tables/plate_stress.csv")
    'tables/plate_stress.csv'
    """
    return PurePosixPath(file).relative_to("results").as_posix()


def index_row(sheet: Sheet, name: str) -> IndexRow:
    """Return the row of the index for a table, in the workbook or only as a file next to it."""
    entry = sheet.entry
    says = entry.title
    if not sheet.in_workbook:
        says += f" (not a sheet: the CSV file {beside(entry.file)} next to this one)"
    return IndexRow(
        name, says, len(sheet.table), sheet.synthetic, entry.file, entry.source, entry.rule,
        sheet.in_workbook,
    )  # fmt: skip
