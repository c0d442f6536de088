"""The first sheet: the answer of the run from its tables, and an index with links."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import PurePosixPath
from typing import assert_never

import pandas as pd
from openpyxl.styles import Font
from openpyxl.utils import get_column_letter
from openpyxl.worksheet.hyperlink import Hyperlink
from openpyxl.worksheet.worksheet import Worksheet

from nptcs.language import tr, translatable
from nptcs.report.cover import cover_lines
from nptcs.report.data import Results
from nptcs.report.sections.summary import findings
from nptcs.report.tables.headings import words
from nptcs.report.tables.names import factor_headings, in_words
from nptcs.report.tables.sheets import Sheet
from nptcs.report.words.surfaces import surface_words
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
from nptcs.report.workbook.layout import (
    HEADER_OF_NUMBERS,
    INDENTED_WRAPPED,
    fit_heights,
    page_for_print,
)
from nptcs.report.workbook.number_formats import format_of_number
from nptcs.tables.analysis.decisions import DecisionConfirmation, Decisions, DecisionStatus
from nptcs.tables.analysis.uncertainty import ResponseUncertainty
from nptcs.tables.published.stiffness import StiffnessErrors

TITLE = "Summary"
FINDING_HEAD = (
    translatable("question"),
    translatable("answer"),
    translatable("in words"),
    *("", "", "", ""),
    translatable("table"),
)
ANSWER_HEAD = (
    translatable("quantity"),
    translatable("in words"),
    translatable("value"),
    translatable("from"),
    translatable("to"),
    translatable("unit"),
    translatable("basis"),
    translatable("table"),
)
INDEX_HEAD = (
    translatable("worksheet"),
    translatable("what it says"),
    translatable("rows"),
    translatable("synthetic"),
    "",
    translatable("rule"),
    translatable("made from"),
    translatable("file"),
)
WIDTHS = (34, 66, 12, 12, 12, 24, 66, 40)
REFERENCE = "reference"


@dataclass(frozen=True)
class Answer:
    """One line of the answer; numbers stay numbers, and `table` names where they come from."""

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
    labels = factor_headings(results.config.studies)
    for row in rows.to_dict("records"):
        yield Answer(
            tr("Stiffness of the reference design at {load}", load=row["at"]),
            tr(
                "{mean} ± {sd} {unit} (mean ± standard deviation) at {design}",
                mean=f"{row['mean']:.4g}",
                sd=f"{row['sd']:.2g}",
                unit=row["unit"],
                design=in_words(row["factors"], labels),
            ),
            "uncertainty.csv",
            row["mean"],
            row["low"],
            row["high"],
            row["unit"],
            tr(
                "study {study}, solver {solver}, {surface}, {cases} cases; {percent} % interval",
                study=row["study"],
                solver=row["solver"],
                surface=surface_words(row["surface"]),
                cases=row["cases"],
                percent=f"{row['confidence_percent']:g}",
            ),
        )


def _decisions(results: Results) -> Iterator[Answer]:
    confirmed = results.table(DecisionConfirmation)
    labels = factor_headings(results.config.studies)
    for row in results.table(Decisions).to_dict("records"):
        yield Answer(
            tr("Design for: {goals}", goals=in_words(row["goals"], labels)),
            _outcome(row["status"], in_words(row["design"] or row["message"], labels)),
            "decisions.csv",
            row["probability"],
            None,
            None,
            tr("probability"),
            tr(
                "study {study}, solver {solver}; required probability {probability}; "
                "confirmation: {confirmation}",
                study=row["study"],
                solver=row["solver"],
                probability=f"{row['with_probability']:g}",
                confirmation=tr(row["confirmation"] or "none"),
            ),
        )
        for one in confirmed[confirmed["decision"] == row["decision"]].to_dict("records"):
            yield Answer(
                tr(
                    "Confirmation, round {round}: {response}",
                    round=one["round"],
                    response=f"{words(one['response'])} {one['at']}".rstrip(),
                ),
                tr(
                    "solved {solved}, predicted {predicted}: {result}",
                    solved=_text(one["solved"]),
                    predicted=_text(one["predicted"]),
                    result=tr(one["result"]),
                ),
                "decision_confirmation.csv",
                one["solved"],
                one["low"],
                one["high"],
                one["unit"],
                tr("from and to: prediction interval of the surface"),
            )


def _trust(results: Results) -> Iterator[Answer]:
    for row in results.table(StiffnessErrors).to_dict("records"):
        if row["group"] == "blind" and row["compared"]:
            yield Answer(
                tr(
                    "Difference from the published stiffness ({study}, {solver})",
                    study=row["study"],
                    solver=row["solver"],
                ),
                tr(
                    "mean {mean} %, largest {largest} % in case {case}",
                    mean=f"{row['mean_percent']:+.2f}",
                    largest=f"{row['largest_percent']:+.2f}",
                    case=row["largest_case_id"],
                ),
                "stiffness_errors.csv",
                row["mean_absolute_percent"],
                None,
                None,
                "%",
                tr("{count} blind cases; value: mean absolute difference", count=row["compared"]),
            )
    synthetic = [s.specimen for s in results.sheet if s.origin == "synthetic"]
    if synthetic:
        yield Answer(
            tr("Origin of the data"),
            tr(
                "{count} of {total} specimens are SYNTHETIC example data; sheets with an orange "
                "header are based on them",
                count=len(synthetic),
                total=len(results.sheet),
            ),
            "specimens.csv",
        )


def _outcome(status: DecisionStatus, text: str) -> str:
    """State the outcome of a decision: its design, the nearest one, or why it was refused."""
    match status:
        case "feasible":
            return text
        case "infeasible":
            return tr("no design meets it; nearest: {design}", design=text)
        case "refused":
            return tr("refused: {reason}", reason=text)
        case _:
            assert_never(status)


def _text(value: float) -> str:
    return tr("no value") if pd.isna(value) else f"{value:.6g}"


def write_summary(worksheet: Worksheet, results: Results, index: Sequence[IndexRow]) -> None:
    """Write the first sheet: what the run is, its answer, and what each sheet is."""
    worksheet.title = TITLE
    for column, width in enumerate(WIDTHS, start=1):
        worksheet.column_dimensions[get_column_letter(column)].width = width
    first = _write_head(worksheet, results) + 1
    row = _write_findings(worksheet, first, results)
    row = _write_answers(worksheet, row + 1, results)
    _write_index(worksheet, row + 1, index)
    fit_heights(worksheet, first, worksheet.max_row)
    page_for_print(worksheet, None)


def _write_head(worksheet: Worksheet, results: Results) -> int:
    """Write title, verdict and identity; return the row after them."""
    sound, line = results.verdict()
    settings, identity = results.config.report, results.identity
    laboratory = results.config.laboratory
    lines = [tr(settings.title), laboratory.name, *laboratory.address.splitlines()]
    lines += [f"{name}: {text}" for name, text in cover_lines(laboratory)]
    lines.append(line)
    if identity is not None:
        made = {"run": identity.short, "date": identity.made_text}
        lines.append(tr("Run {run}, tables complete {date}", **made))
    synthetic = tr("SYNTHETIC example data: sheets with an orange header are based on it.")
    if results.any_synthetic:
        lines.append(synthetic)
    lines.append(
        tr(
            "Rows: red failed, yellow flagged, grey left out, not assessed, assumed or calibrated "
            "on. Units: in brackets. Point at a heading to see what it means, its rule and its "
            "range."
        )
    )
    for row, text in enumerate(filter(None, lines), start=1):
        cell = worksheet.cell(row, 1)
        write(cell, text)
        cell.font = Font(name=FONT, bold=row == 1 or text == line, size=14 if row == 1 else 11)
        if text == line and not sound:
            cell.fill = FILLS["bad"]
        if text == synthetic:
            cell.fill = SYNTHETIC
    return worksheet.max_row + 1


def _write_findings(worksheet: Worksheet, top: int, results: Results) -> int:
    """Write the findings of the report's first screen; return the row after them."""
    head_row(worksheet, top, list(map(tr, FINDING_HEAD)))
    for row, one in enumerate(findings(results), start=top + 1):
        badge = f" ({tr('SYNTHETIC DATA')})" if one.synthetic else ""
        known = [one.question, one.answer + badge, one.words, None, None, None, None, one.source]
        write_row(worksheet, row, known)
        for column in range(1, len(FINDING_HEAD) + 1):
            worksheet.cell(row, column).alignment = WRAPPED
        worksheet.merge_cells(start_row=row, end_row=row, start_column=3, end_column=7)
        worksheet.cell(row, 2).font = Font(name=FONT, bold=True)
        if one.synthetic:
            worksheet.cell(row, 2).fill = SYNTHETIC
    return worksheet.max_row + 1


def _write_answers(worksheet: Worksheet, top: int, results: Results) -> int:
    """Write the answers; return the row after them."""
    head_row(worksheet, top, list(map(tr, ANSWER_HEAD)))
    for column in (3, 4, 5):
        worksheet.cell(top, column).alignment = HEADER_OF_NUMBERS
    worksheet.cell(top, 6).alignment = INDENTED_WRAPPED
    for row, one in enumerate(answers(results), start=top + 1):
        known = (one.question, one.answer, one.value, one.low, one.high, one.unit, one.basis)
        write_row(worksheet, row, [*known, one.table])
        for column in (3, 4, 5):
            cell = worksheet.cell(row, column)
            if cell.data_type == "n" and cell.value is not None:
                cell.number_format = format_of_number(float(cell.value))
        for column in range(1, len(ANSWER_HEAD) + 1):
            worksheet.cell(row, column).alignment = WRAPPED
        worksheet.cell(row, 6).alignment = INDENTED_WRAPPED
    return worksheet.max_row + 1


def _write_index(worksheet: Worksheet, top: int, index: Sequence[IndexRow]) -> None:
    head_row(worksheet, top, list(map(tr, INDEX_HEAD)))
    worksheet.cell(top, 3).alignment = HEADER_OF_NUMBERS
    worksheet.cell(top, 4).alignment = INDENTED_WRAPPED
    for row, one in enumerate(index, start=top + 1):
        synthetic = None if one.synthetic is None else tr("yes") if one.synthetic else tr("no")
        known = [one.name, one.says, one.rows, synthetic, None, one.rule, one.source, one.file]
        write_row(worksheet, row, known)
        cell = worksheet.cell(row, 1)
        if one.here:
            cell.hyperlink = Hyperlink(ref=cell.coordinate, location=f"'{one.name}'!A1")
        else:
            cell.hyperlink = next_to_workbook(one.file)
        cell.font = LINK
        for column in range(1, len(INDEX_HEAD) + 1):
            worksheet.cell(row, column).alignment = WRAPPED
        worksheet.cell(row, 4).alignment = INDENTED_WRAPPED


def next_to_workbook(file: str) -> str:
    """Return the address of a result next to the workbook, which is in ``results``.

    Examples
    --------
    >>> next_to_workbook("results/tables/plate_stress.csv")
    'tables/plate_stress.csv'
    """
    return PurePosixPath(file).relative_to("results").as_posix()


def index_row(sheet: Sheet, name: str) -> IndexRow:
    """Return the row of the index for a table, in the workbook or only as a file next to it."""
    entry = sheet.entry
    says = tr(entry.title)
    if not sheet.in_workbook:
        file = next_to_workbook(entry.file)
        says = tr(
            "{title} (not a sheet: see the CSV file {file} next to this workbook)",
            title=says,
            file=file,
        )
    return IndexRow(
        name,
        says,
        len(sheet.table),
        sheet.synthetic,
        tr(entry.file),
        tr(entry.source),
        entry.rule,
        sheet.in_workbook,
    )
