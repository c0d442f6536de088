"""The workbook as a whole: which sheets it has, in which order, and its properties."""

from __future__ import annotations

import io
import re
import zipfile
from datetime import UTC, datetime

from openpyxl import Workbook
from openpyxl.workbook.properties import CalcProperties

from nptcs.language import language, tr, translatable
from nptcs.report.data import Results
from nptcs.report.tables.dictionary import dictionary_table
from nptcs.report.tables.sheets import sheets_of
from nptcs.report.workbook.cell_xml import quick_cells
from nptcs.report.workbook.cells import write_row
from nptcs.report.workbook.chart_data import charts_of
from nptcs.report.workbook.charts import CHARTS, DATA, write_charts
from nptcs.report.workbook.layout import finish_table
from nptcs.report.workbook.predictor import PREDICTOR, TERMS, write_predictor
from nptcs.report.workbook.summary import IndexRow, index_row, write_summary
from nptcs.report.workbook.table_sheets import sheet_name, write_table_sheet

FIXED_DATE = datetime(1980, 1, 1, tzinfo=UTC)
"""Date of a workbook whose run has none, and of the parts of the archive that a workbook is."""

DICTIONARY = "columns"
OWN_SHEETS = {
    PREDICTOR: translatable(
        "Live formulas of the stored polynomials: five input cells, warnings outside the range of "
        "validity"
    ),
    CHARTS: translatable("Native charts of the main curves"),
    TERMS: translatable("What the predictor evaluates: coefficients, terms and covariances"),
    DATA: translatable("The numbers shown in the charts"),
    DICTIONARY: translatable("The meaning of each column of each table"),
}
"""Sheets that are not tables of the run, in the order of the index."""


def build_workbook(results: Results) -> bytes:
    """Write all results as one XLSX file.

    Numbers are stored to 16 significant digits and shown with the digits that suit their unit and
    size. Titles, headings and sentences are in the language of the run; names of sheets, columns
    and things are those of the CSV files. The same results give the same bytes.

    Parameters
    ----------
    results : Results
        Everything that a run has made.

    Returns
    -------
    bytes
        Content of the XLSX file.
    """
    with language(results.config.laboratory.language):
        workbook = _written(results)
    stream = io.BytesIO()
    with quick_cells():
        workbook.save(stream)
    return dated(stream.getvalue(), _date(results))


def _written(results: Results) -> Workbook:
    """Write all sheets, in the language of the run."""
    workbook = Workbook()
    summary = workbook.active
    write_predictor(workbook, results)
    if charts := charts_of(results):
        write_charts(workbook, charts)
    tables = []
    for sheet in sheets_of(results).values():
        name = sheet_name(sheet, workbook)
        tables.append(index_row(sheet, name))
        if sheet.in_workbook:
            write_table_sheet(workbook.create_sheet(name), sheet)
    _write_dictionary(workbook, results)
    own = [
        IndexRow(name, tr(says)) for name, says in OWN_SHEETS.items() if name in workbook.sheetnames
    ]
    write_summary(summary, results, [*own, *tables])
    for name in (TERMS, DATA):
        if name in workbook.sheetnames:
            workbook.move_sheet(name, len(workbook.sheetnames))
    _describe(workbook, results)
    return workbook


def _write_dictionary(workbook: Workbook, results: Results) -> None:
    """Write the sheet that explains every column."""
    sheet = workbook.create_sheet(DICTIONARY)
    heads = (tr("worksheet"), tr("column"), tr("unit"), tr("column in the file"), tr("meaning"))
    write_row(sheet, 1, heads)
    table = dictionary_table(list(sheets_of(results).values()))
    for row, values in enumerate(table.itertuples(index=False), start=2):
        write_row(sheet, row, list(values))
    finish_table(sheet)


def _describe(workbook: Workbook, results: Results) -> None:
    """Set title, author, subject and date, and let programs compute the formulas on opening."""
    settings, identity = results.config.report, results.identity
    properties = workbook.properties
    properties.title = tr(settings.title)
    properties.creator = properties.lastModifiedBy = results.config.laboratory.name or "nptcs"
    properties.subject = f"{tr('Results of a run of nptcs')} {identity.short if identity else ''}"
    properties.description = results.verdict()[1]
    properties.keywords = "non-pneumatic tyre; response surface; " + (
        f"run {identity.identity}" if identity else "run without identity"
    )
    workbook.calculation = CalcProperties(fullCalcOnLoad=True)


def _date(results: Results) -> datetime:
    return results.identity.made if results.identity else FIXED_DATE


def dated(content: bytes, date: datetime) -> bytes:
    """Replace the times that openpyxl writes into a workbook by the date of the run.

    Parameters
    ----------
    content : bytes
        An XLSX file.
    date : datetime
        When the run was made; equal content and date give equal bytes.

    Returns
    -------
    bytes
        The same workbook; its parts have the date `FIXED_DATE`, its properties `date`.
    """
    stream = io.BytesIO()
    moment = date.astimezone(UTC).strftime("%Y-%m-%dT%H:%M:%SZ").encode()
    with (
        zipfile.ZipFile(io.BytesIO(content)) as source,
        zipfile.ZipFile(stream, "w", zipfile.ZIP_DEFLATED) as target,
    ):
        for name in source.namelist():
            data = source.read(name)
            if name == "docProps/core.xml":
                data = re.sub(rb"\d{4}-\d\d-\d\dT\d\d:\d\d:\d\dZ", moment, data)
            entry = zipfile.ZipInfo(name, FIXED_DATE.timetuple()[:6])
            entry.compress_type = zipfile.ZIP_DEFLATED
            target.writestr(entry, data)
    return stream.getvalue()
