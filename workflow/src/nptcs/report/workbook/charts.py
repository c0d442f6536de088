"""Native charts, which a reader can restyle and copy, and the sheet with their data."""

from __future__ import annotations

from collections.abc import Sequence
from math import floor, log10

import numpy as np
from openpyxl import Workbook
from openpyxl.chart import Reference, ScatterChart, Series
from openpyxl.chart.shapes import GraphicalProperties
from openpyxl.chart.text import RichText, Text
from openpyxl.chart.title import Title
from openpyxl.drawing.line import LineProperties
from openpyxl.drawing.text import (
    CharacterProperties,
    Paragraph,
    ParagraphProperties,
    RegularTextRun,
)
from openpyxl.utils import get_column_letter
from openpyxl.worksheet.pagebreak import Break
from openpyxl.worksheet.worksheet import Worksheet

from nptcs.arrays import Array
from nptcs.language import tr
from nptcs.report.workbook.cells import head_row, write, write_row, write_title
from nptcs.report.workbook.chart_data import ChartData
from nptcs.report.workbook.layout import page_for_print
from nptcs.report.workbook.number_formats import format_of_number

CHARTS, DATA = "charts", "chart_data"
COLOURS = ("0072B2", "D55E00", "009E73", "CC79A7", "E69F00", "56B4E9", "000000")
"""Those of Okabe and Ito, as in the report's figures."""

MARKS = ("circle", "square", "triangle", "diamond", "star", "x", "plus")
SIZE_CM = (16.5, 9.0)
ROWS_EACH, COLUMNS_EACH = 19, 9
HEADER_ROW = 3
DATA_WIDTH = 14


def write_charts(workbook: Workbook, charts: Sequence[ChartData]) -> None:
    """Write the sheet of charts, and the sheet with their data.

    Parameters
    ----------
    workbook : Workbook
    charts : sequence of ChartData
        Two in each row of the sheet.
    """
    sheet, data = workbook.create_sheet(CHARTS), workbook.create_sheet(DATA)
    write_title(
        sheet,
        tr("Charts of the main curves"),
        [
            tr(
                "Native charts: change, copy and print them. Their numbers are in the sheet "
                "{sheet}.",
                sheet=DATA,
            )
        ],
    )
    lines = [tr("Two columns for each line: x and y.")]
    write_title(data, tr("Numbers shown in the charts"), lines)
    column = 1
    for number, chart in enumerate(charts):
        drawn = _chart(data, chart, column)
        left = 1 + COLUMNS_EACH * (number % 2)
        top = 4 + ROWS_EACH * (number // 2)
        sheet.add_chart(drawn, f"{get_column_letter(left)}{top}")
        column += 2 * len(chart.lines)
    last = 4 + ROWS_EACH * ((len(charts) + 1) // 2)
    page_for_print(sheet, None, f"A1:{get_column_letter(2 * COLUMNS_EACH)}{last}")
    for row in range(3 + 2 * ROWS_EACH, last, 2 * ROWS_EACH):
        sheet.row_breaks.append(Break(id=row - 1))  # no chart is split between pages
    for place in range(1, column):
        data.column_dimensions[get_column_letter(place)].width = DATA_WIDTH
    data.freeze_panes = data.cell(HEADER_ROW + 2, 1)
    page_for_print(data, HEADER_ROW + 1)


def _chart(data: Worksheet, chart: ChartData, column: int) -> ScatterChart:
    """Write the data of a chart, starting at a column, and draw it."""
    drawn = ScatterChart(scatterStyle="lineMarker")
    badge = f" ({tr('SYNTHETIC DATA')})" if chart.synthetic else ""
    drawn.width, drawn.height = SIZE_CM
    drawn.title = _title(chart.title + badge, 1100, True)
    drawn.x_axis.title = _title(chart.x_title, 900, False)
    drawn.y_axis.title = _title(chart.y_title, 900, False)
    drawn.x_axis.delete = drawn.y_axis.delete = False
    drawn.x_axis.number_format = _axis_format([line.x for line in chart.lines])
    drawn.y_axis.number_format = _axis_format([line.y for line in chart.lines])
    drawn.x_axis.crosses = drawn.y_axis.crosses = "min"
    drawn.legend.position = "b"
    for axis in (drawn.x_axis, drawn.y_axis):
        axis.tickLblPos = "low"
        axis.majorGridlines.spPr = GraphicalProperties(ln=LineProperties(solidFill="DDDDDD"))
    named = tr("{title}, from {file}", title=chart.title + badge, file=chart.source)
    write(data.cell(HEADER_ROW, column), named)
    for number, line in enumerate(chart.lines):
        place = column + 2 * number
        head_row(data, HEADER_ROW + 1, [chart.x_title, line.name], place)
        for row, pair in enumerate(zip(line.x, line.y, strict=True), start=HEADER_ROW + 2):
            write_row(data, row, pair, place)
            for offset, value in enumerate(pair):
                data.cell(row, place + offset).number_format = format_of_number(float(value))
        last = HEADER_ROW + 1 + len(line.x)
        x = Reference(data, min_col=place, min_row=HEADER_ROW + 2, max_row=last)
        y = Reference(data, min_col=place + 1, min_row=HEADER_ROW + 1, max_row=last)
        drawn.series.append(
            _styled(Series(y, x, title_from_data=True), number, chart.points, line.guide)
        )
    return drawn


def _axis_format(values: Sequence[Array]) -> str:
    """Choose the decimals of an axis by a fifth of its span, which is about a tick."""
    numbers = np.concatenate(values)
    span = float(np.ptp(numbers)) or abs(float(numbers[0])) or 1.0
    decimals = max(0, -floor(log10(span / 5)))
    return "0" + ("." + "0" * decimals if decimals else "")


def _title(text: str, size: int, bold: bool) -> Title:
    """Make a title in hundredths of a point; programs take 18 points where no size is given."""
    look = CharacterProperties(sz=size, b=bold)
    run = RegularTextRun(rPr=look, t=text)
    paragraph = Paragraph(pPr=ParagraphProperties(defRPr=look), r=[run])
    title = Title(overlay=False)
    title.tx = Text(rich=RichText(p=[paragraph]))
    return title


def _styled(series: Series, number: int, points: bool, guide: bool) -> Series:
    """Give a line its colour and mark; in a chart of points only a guide is a line."""
    colour = COLOURS[number % len(COLOURS)]
    series.smooth = False
    series.graphicalProperties = GraphicalProperties()
    if points and not guide:
        series.graphicalProperties.line = LineProperties(noFill=True)
        series.marker.symbol, series.marker.size = MARKS[number % len(MARKS)], 5
        series.marker.graphicalProperties = GraphicalProperties(solidFill=colour)
        series.marker.graphicalProperties.line = LineProperties(solidFill=colour)
    else:
        dash = "dash" if guide else None
        series.graphicalProperties.line = LineProperties(
            solidFill="666666" if guide else colour, w=15875, prstDash=dash
        )
        series.marker.symbol = "none"
    return series
