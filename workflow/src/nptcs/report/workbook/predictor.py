"""The predictor: five input cells, and the stored polynomials as live formulas.

The sheet `PREDICTOR` has the inputs and one row per polynomial; the sheet `TERMS` has one block per
polynomial with all that it is evaluated from. A polynomial is Σ b_j Π c_i^e_ij in coded units
c = (x - centre)/(half range), as in `nptcs.surface.fit`; one of log K or 1/K is transformed back.
Its prediction interval is ± t s √(1 + zᵀ(XᵀX)⁻¹z), with the terms z at the point.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from openpyxl import Workbook
from openpyxl.formatting.rule import FormulaRule
from openpyxl.styles import Alignment, Border, Font, PatternFill, Protection, Side
from openpyxl.utils import get_column_letter
from openpyxl.worksheet.datavalidation import DataValidation
from openpyxl.worksheet.worksheet import Worksheet

from nptcs.config.solvers.tyre import TyreGeometry
from nptcs.config.studies.study import Study
from nptcs.language import tr, translatable
from nptcs.report.data import Results
from nptcs.report.tables.headings import words
from nptcs.report.words.surfaces import surface_words
from nptcs.report.workbook.cells import (
    FONT,
    INPUT,
    SYNTHETIC,
    head_row,
    write,
    write_row,
    write_title,
)
from nptcs.report.workbook.layout import page_for_print
from nptcs.report.workbook.number_formats import format_of_number
from nptcs.report.workbook.predictor_models import (
    INPUTS,
    SPACING,
    PredictorModel,
    predictor_models,
    start_values,
)
from nptcs.report.workbook.predictor_terms import Block, write_block
from nptcs.surface.registry import STIFFNESS, FittedSurface

PREDICTOR, TERMS = "predictor", "predictor_terms"
FIRST_INPUT = 6
VALUE, PLATES_ROW = "D", FIRST_INPUT + len(INPUTS) + 1
INSIDE = translatable("inside")
COLUMNS = (
    translatable("study"),
    translatable("solver"),
    translatable("response"),
    translatable("at"),
    translatable("unit"),
    translatable("surface"),
    translatable("prediction"),
    translatable("interval from"),
    translatable("interval to"),
    translatable("range of validity"),
    translatable("its inputs, and the values held by its study"),
    translatable("data"),
)
INPUT_COLUMNS = (
    translatable("input"),
    translatable("symbol"),
    translatable("unit"),
    translatable("value"),
    translatable("lowest"),
    translatable("highest"),
)
WIDTHS = (26, 16, 30, 13, 13, 26, 16, 16, 16, 30, 62, 17)
PLACE = "\N{REPLACEMENT CHARACTER}"
"""Placeholder for the number that a formula inserts into a sentence."""

LIGHT_RED = PatternFill("solid", start_color="FDD9C8", end_color="FDD9C8")


def write_predictor(workbook: Workbook, results: Results) -> None:
    """Write both sheets; a run without polynomials of the inputs has neither."""
    models, others = predictor_models(results)
    if not models:
        return
    sheet, terms = workbook.create_sheet(PREDICTOR), workbook.create_sheet(TERMS)
    cells = _write_inputs(sheet, results, models)
    write_title(
        terms,
        tr("What the predictor evaluates: one block per polynomial"),
        [
            tr(
                "Terms are in coded units, c = (x − centre) / half range; the inputs are those of "
                "the sheet {sheet}.",
                sheet=PREDICTOR,
            )
        ],
    )
    row, blocks = 4, []
    for model in models:
        block = write_block(terms, row, model, cells)
        blocks.append(block)
        row = block.last_row + 2
    _write_predictions(sheet, models, blocks, results)
    _write_warning(sheet, len(models))
    _say_what_is_missing(sheet, others)
    _finish(sheet, terms)


def _write_inputs(
    sheet: Worksheet, results: Results, models: Sequence[PredictorModel]
) -> dict[str, str]:
    """Write the input cells and the whole number of plates; return the cell of each factor.

    The key ``realised`` is the cell of the spacing that a solver with whole plates uses.
    """
    write_title(
        sheet,
        tr("Predictor: change the yellow cells"),
        [
            tr(
                "Every prediction below is a live formula of the stored polynomial, with its 95 % "
                "prediction interval."
            )
        ],
    )
    head_row(sheet, FIRST_INPUT - 1, list(map(tr, INPUT_COLUMNS)))
    start = start_values(results, models)
    cells = {}
    for row, (factor, (symbol, name, unit)) in enumerate(INPUTS.items(), start=FIRST_INPUT):
        lowest, highest = _range_of(factor, models)
        write_row(sheet, row, [tr(name), symbol, unit, start.get(factor), lowest, highest])
        for column in "EF":
            sheet[f"{column}{row}"].number_format = "0.####"
        cell = sheet[f"{VALUE}{row}"]
        cell.fill, cell.protection = INPUT, Protection(locked=False)
        cell.border = Border(*[Side("thin", color="B8860B")] * 4)
        cell.font = Font(name=FONT, bold=True)
        cells[factor] = f"'{PREDICTOR}'!${VALUE}${row}"
    numbers = DataValidation("decimal", operator="greaterThanOrEqual", formula1="0")
    numbers.errorTitle, numbers.error = tr("Not a number"), tr("Give a number, zero or more.")
    numbers.showErrorMessage = True
    numbers.add(f"{VALUE}{FIRST_INPUT}:{VALUE}{FIRST_INPUT + len(INPUTS) - 1}")
    sheet.add_data_validation(numbers)
    cells["realised"] = _write_plates(sheet, results.config.tyre)
    return cells


def _write_plates(sheet: Worksheet, tyre: TyreGeometry) -> str:
    """Write how many plates a leg has at the spacing, as `TyreGeometry.plates_across`."""
    row, spacing = PLATES_ROW, f"{VALUE}{FIRST_INPUT}"
    write_row(sheet, row, [tr("width of the tread"), "", "mm", tyre.tread_width_mm])
    write_row(sheet, row + 1, [tr("width of a plate"), "", "mm", tyre.plate_width_mm])
    write_row(sheet, row + 2, [tr("plates across the width"), "", "1"])
    write_row(sheet, row + 3, [tr("spacing with whole plates"), "S", "mm"])
    width, plate, plates = (f"{VALUE}{row + place}" for place in range(3))
    sheet[plates] = f"=IF({spacing}>0,INT(({width}-{plate})/{spacing}+1E-9)+1,NA())"
    realised = f"{VALUE}{row + 3}"
    sheet[realised] = f"={width}/{plates}"
    sheet[realised].number_format = "0.0000"
    return f"'{PREDICTOR}'!${VALUE}${row + 3}"


def _range_of(factor: str, models: Sequence[PredictorModel]) -> tuple[float | None, float | None]:
    """Return the range of a factor in which at least one polynomial is valid."""
    bounds = [
        (low, high)
        for model in models
        for name, low, high in zip(model.fitted.factors, *model.bounds(), strict=True)
        if name == factor
    ]
    if not bounds:
        return None, None
    return float(min(low for low, _ in bounds)), float(max(high for _, high in bounds))


def first_row(workbook_row: int = 0) -> int:
    """Return the row of a prediction in the sheet, counted from 0 for the first."""
    return PLATES_ROW + 8 + workbook_row


def _write_predictions(
    sheet: Worksheet,
    models: Sequence[PredictorModel],
    blocks: Sequence[Block],
    results: Results,
) -> None:
    head = first_row() - 1
    head_row(sheet, head, list(map(tr, COLUMNS)))
    for place, (model, block) in enumerate(zip(models, blocks, strict=True)):
        row, fitted = first_row(place), model.fitted
        study = results.config.study(fitted.study)
        write_row(sheet, row, _named(fitted, study))
        synthetic = results.study_is_synthetic(study, fitted.solver)
        write_row(sheet, row, [takes(model), tr("SYNTHETIC") if synthetic else ""], 11)
        if synthetic:
            sheet[f"L{row}"].fill = SYNTHETIC
        for column, formula in zip(
            "GHIJ", (block.value, block.low, block.high, block.validity), strict=True
        ):
            sheet[f"{column}{row}"] = formula
        for column in "GHI":
            cell = sheet[f"{column}{row}"]
            cell.number_format = format_of_number(float(fitted.surface.y.max()))
            cell.alignment = Alignment(horizontal="right")
    last = first_row(len(models) - 1)
    rule = FormulaRule(formula=[f'$J{first_row()}<>"{tr(INSIDE)}"'], fill=LIGHT_RED)
    sheet.conditional_formatting.add(f"G{first_row()}:J{last}", rule)


def _named(fitted: FittedSurface, study: Study) -> list[str]:
    """Name a surface: study, solver, response, at which load, unit, kind."""
    response = fitted.response
    at, unit = response.at, response.unit
    if response.name == STIFFNESS:
        at, unit = f"{study.load_n:g} N", "N/mm"
    words_of = words(response.name.removesuffix("_n_per_mm"))
    return [fitted.study, fitted.solver, words_of, at, unit, surface_words(fitted.name)]


def takes(model: PredictorModel) -> str:
    """Say which inputs a polynomial has, what its study holds fixed, and what has no effect."""
    taken = [
        tr("{symbol} with whole plates", symbol=INPUTS[name][0])
        if name == SPACING and model.snaps
        else INPUTS[name][0]
        for name in model.fitted.factors
    ]
    held = [f"{INPUTS[name][0]} = {value:g}" for name, value in model.fixed.items()]
    absent = [
        symbol
        for name, (symbol, _, _) in INPUTS.items()
        if name not in {*model.fitted.factors, *model.fixed}
    ]
    parts = [tr("inputs {inputs}", inputs=", ".join(taken))]
    parts += [tr("its study holds {inputs}", inputs=", ".join(held))] if held else []
    parts += [tr("does not depend on {inputs}", inputs=", ".join(absent))] if absent else []
    return "; ".join(parts)


def _write_warning(sheet: Worksheet, count: int) -> None:
    """Write the cell that warns where polynomials are outside their range."""
    row, last = PLATES_ROW + 5, first_row(count - 1)
    checks = f"J{first_row()}:J{last}"
    inside = f'COUNTIF({checks},"{tr(INSIDE)}")'
    sound = tr("All {count} polynomials are valid at these inputs.", count=count)
    before, after = tr(
        "WARNING: {outside} of {count} polynomials are outside their range at these inputs; their "
        "rows are red and have no interval.",
        outside=PLACE,
        count=count,
    ).split(PLACE)
    warning = f'"{before}"&({count}-{inside})&"{after}"'
    sheet[f"A{row}"] = f'=IF({inside}={count},"{sound}",{warning})'
    sheet[f"A{row}"].font = Font(name=FONT, bold=True)
    fixed = f'COUNTIF($J${first_row()}:$J${last},"{tr(INSIDE)}")'
    warned = FormulaRule(formula=[f"{fixed}<{count}"], fill=LIGHT_RED)
    sheet.conditional_formatting.add(f"A{row}:J{row}", warned)


def _say_what_is_missing(sheet: Worksheet, others: Mapping[str, int]) -> None:
    """Name the surfaces that no formula evaluates."""
    if others:
        text = tr(
            "Not here, because they are not polynomials of the inputs: {named}. The report and "
            "nptcs design evaluate them.",
            named=", ".join(f"{count} × {surface_words(name)}" for name, count in others.items()),
        )
        write(sheet.cell(PLATES_ROW + 6, 1), text)


def _finish(sheet: Worksheet, terms: Worksheet) -> None:
    for column, width in enumerate(WIDTHS, start=1):
        sheet.column_dimensions[get_column_letter(column)].width = width
    sheet.freeze_panes = sheet.cell(FIRST_INPUT - 1, 1)
    page_for_print(sheet, first_row() - 1)
    for column in range(1, terms.max_column + 1):
        terms.column_dimensions[get_column_letter(column)].width = 34 if column == 1 else 17
    terms.freeze_panes = "B4"
    page_for_print(terms, None, f"A1:I{terms.max_row}")
