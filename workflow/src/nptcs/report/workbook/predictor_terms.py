"""One polynomial as a block of cells: coded inputs, terms, covariance, value and interval."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from openpyxl.styles import Font
from openpyxl.worksheet.worksheet import Worksheet

from nptcs.config.studies.surface import Link
from nptcs.language import tr, translatable
from nptcs.report.words.surfaces import surface_words
from nptcs.report.workbook.cells import FONT, head_row, write, write_row
from nptcs.report.workbook.number_formats import EXACT
from nptcs.report.workbook.predictor_models import INPUTS, SPACING, PredictorModel
from nptcs.surface.response_surface import INSIDE_TOLERANCE

FACTOR_COLUMNS = (
    translatable("factor"),
    translatable("value"),
    translatable("lowest"),
    translatable("highest"),
    translatable("centre"),
    translatable("half range"),
    translatable("coded"),
    translatable("inside"),
)
TERM_COLUMNS = (
    translatable("term"),
    translatable("coefficient, coded"),
    translatable("value of the term"),
    translatable("product"),
)
COVARIANCE = 6
"""Column at which the covariance matrix of the coefficients begins."""

HELD_TOLERANCE = 1e-9

INVERSE: Mapping[Link, str] = {"identity": "{}", "log": "EXP({})", "reciprocal": "1/({})"}


@dataclass(frozen=True)
class Block:
    """Formulas that refer to a block, and its last row."""

    value: str
    low: str
    high: str
    validity: str
    last_row: int


def write_block(
    sheet: Worksheet, row: int, model: PredictorModel, cells: Mapping[str, str]
) -> Block:
    """Write the block of a polynomial, starting at a row.

    Parameters
    ----------
    sheet : Worksheet
    row : int
        The first row of the block.
    model : PredictorModel
    cells : mapping of str to str
        Cell of each input by the name of the factor, and ``realised`` for the spacing with whole
        plates.

    Returns
    -------
    Block
        Formulas for the sheet with the predictions.
    """
    fitted = model.fitted
    head = f"{fitted.study}, {fitted.solver}, {surface_words(fitted.name)}: {fitted.response}"
    write(sheet.cell(row, 1), head)
    sheet.cell(row, 1).font = Font(name=FONT, bold=True, size=12)
    first = row + 2
    head_row(sheet, row + 1, list(map(tr, FACTOR_COLUMNS)))
    coded = _write_factors(sheet, first, model, cells)
    held = _write_held(sheet, first + len(coded), model, cells)
    top = held + 1
    head_row(sheet, top, list(map(tr, TERM_COLUMNS)))
    write(sheet.cell(top, COVARIANCE), tr("covariance of the coefficients, coded"))
    last = _write_terms(sheet, top + 1, model, coded)
    return _results(sheet, last + 1, model, (first, held - 1), (top + 1, last))


def _write_factors(
    sheet: Worksheet, first: int, model: PredictorModel, cells: Mapping[str, str]
) -> list[str]:
    """Write one row per factor; return the cells of the coded values."""
    centre, half = model.inner.coding()
    lower, upper = model.bounds()
    for place, name in enumerate(model.fitted.factors):
        row = first + place
        whole = name == SPACING and model.snaps
        symbol = INPUTS[name][0]
        label = tr("{symbol}, whole plates", symbol=symbol) if whole else symbol
        write_row(sheet, row, [label, None, lower[place], upper[place], centre[place], half[place]])
        sheet[f"B{row}"] = f"={cells['realised' if whole else name]}"
        sheet[f"G{row}"] = f"=(B{row}-E{row})/F{row}"
        slack = f"{INSIDE_TOLERANCE:.0E}*(D{row}-C{row})"
        sheet[f"H{row}"] = f"=IF(AND(B{row}>=C{row}-{slack},B{row}<=D{row}+{slack}),1,0)"
    return [f"G{first + place}" for place in range(len(model.fitted.factors))]


def _write_held(
    sheet: Worksheet, first: int, model: PredictorModel, cells: Mapping[str, str]
) -> int:
    """Write one row per value that the study holds; return the row after them."""
    row = first
    for name, value in model.fixed.items():
        held = tr("{symbol}, held by the study", symbol=INPUTS[name][0])
        write_row(sheet, row, [held, None, value, value])
        sheet[f"B{row}"] = f"={cells[name]}"
        sheet[f"H{row}"] = f"=IF(ABS(B{row}-C{row})<={HELD_TOLERANCE:.0E}*ABS(C{row}),1,0)"
        row += 1
    return row


def _write_terms(sheet: Worksheet, first: int, model: PredictorModel, coded: Sequence[str]) -> int:
    """Write one row per term with its row of the covariance matrix; return the last row."""
    inner = model.inner
    for place, powers in enumerate(inner.polynomial.exponents):
        row = first + place
        write(sheet.cell(row, 1), inner.polynomial.names[place])
        write(sheet.cell(row, 2), inner.coefficients_coded[place])
        sheet[f"C{row}"] = f"={term_formula(powers, coded)}"
        sheet[f"D{row}"] = f"=B{row}*C{row}"
        write_row(sheet, row, inner.covariance_coded[place], COVARIANCE)
        for column in range(COVARIANCE, COVARIANCE + len(inner.polynomial)):
            sheet.cell(row, column).number_format = EXACT
        sheet.cell(row, 2).number_format = EXACT
    return first + len(inner.polynomial) - 1


def term_formula(powers: Sequence[int], cells: Sequence[str]) -> str:
    """Write a term of coded values; factors with the power 0 are left out.

    A spreadsheet has no value for 0^0, which would occur at every centre of a design.

    Examples
    --------
    >>> term_formula((0, 2, 1), ["G3", "G4", "G5"]), term_formula((0, 0), ["G3", "G4"])
    ('G4^2*G5', '1')
    """
    parts = [
        cell if power == 1 else f"{cell}^{power}"
        for power, cell in zip(powers, cells, strict=True)
        if power
    ]
    return "*".join(parts) or "1"


def _results(
    sheet: Worksheet,
    row: int,
    model: PredictorModel,
    checked: tuple[int, int],
    terms: tuple[int, int],
) -> Block:
    """Write polynomial, half width and check below the terms, and refer to them."""
    top, last = terms
    count = len(model.inner.polynomial)
    z = f"$C${top}:$C${last}"
    corner = sheet.cell(top, COVARIANCE).coordinate
    end = sheet.cell(last, COVARIANCE + count - 1).coordinate
    for place, (label, value) in enumerate(
        (
            (tr("polynomial"), f"=SUM(D{top}:D{last})"),
            (tr("Student's t"), model.t_quantile),
            (tr("standard deviation s"), model.inner.residual_sd),
            (tr("variance of the polynomial"), f"=SUMPRODUCT(MMULT({corner}:{end},{z}),{z})"),
            (tr("half width"), f"=B{row + 1}*SQRT(B{row + 3}+B{row + 2}^2)"),
            (tr("checks that fail"), f"=COUNTIF(H{checked[0]}:H{checked[1]},0)"),
        )
    ):
        write(sheet.cell(row + place, 1), label)
        sheet.cell(row + place, 2).value = value
    name = f"'{sheet.title}'!"
    inner, half, fails = (f"{name}$B${row + place}" for place in (0, 4, 5))
    low, high = _interval(model.link, inner, half)
    none = tr("not assessed")
    outside = [
        f'IF({name}$H${place}=0,"{sheet.cell(place, 1).value}; ","")'
        for place in range(checked[0], checked[1] + 1)
    ]
    return Block(
        value=f"={INVERSE[model.link].format(inner)}",
        low=f'=IF({fails}=0,{low},"{none}")',
        high=f'=IF({fails}=0,{high},"{none}")',
        validity=f'=IF({fails}=0,"{tr("inside")}",TRIM("{tr("outside:")} "&{"&".join(outside)}))',
        last_row=row + 5,
    )


def _interval(link: Link, inner: str, half: str) -> tuple[str, str]:
    """Transform the interval back; where that of 1/K reaches zero, K has no upper bound."""
    low, high = f"{inner}-{half}", f"{inner}+{half}"
    if link == "reciprocal":
        return f"1/({high})", f'IF({low}>0,1/({low}),"{tr("no upper bound")}")'
    return INVERSE[link].format(low), INVERSE[link].format(high)
