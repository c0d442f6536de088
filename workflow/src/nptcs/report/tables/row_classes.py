"""Which rows of a table are marked: ``bad`` failed, ``warn`` flagged, ``out`` left out."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping
from typing import assert_never

from nptcs.tables.laboratory.files import FileStatus
from nptcs.tables.result_table import RowMark

Row = Mapping[str, object]
RowClass = Callable[[Row], str]


def row_class(mark: RowMark, left_out: Collection[str] = ()) -> RowClass:
    """Return the function that gives the class of a row.

    Parameters
    ----------
    mark : RowMark
        What marks a row.
    left_out : collection of str
        Specimens that the sheet leaves out, for `RowMark.SPECIMEN`.
    """
    match mark:
        case RowMark.NONE:
            return no_row
        case RowMark.EVERY_ROW:
            return every_row
        case RowMark.STATUS:
            return by_status
        case RowMark.STATUS_OR_CALIBRATION:
            return by_calibration
        case RowMark.FILE_STATUS:
            return by_file_status
        case RowMark.INCLUDE:
            return by_include
        case RowMark.SPECIMEN:
            return of_specimens(left_out)
        case RowMark.OUTLIERS:
            return by_outliers
        case RowMark.ORIGIN:
            return by_origin
        case RowMark.DEVIATION:
            return by_deviation
        case _:
            assert_never(mark)


def no_row(row: Row) -> str:
    """Mark no row."""
    return ""


def every_row(row: Row) -> str:
    """Mark every row: a table of problems."""
    return "bad"


WITHOUT_FAULT = {"ok": "", "not assessed": "out", "not reached": "warn"}
"""Class of a status that is no failure."""


def by_status(row: Row) -> str:
    """Mark everything whose status is not ok: as failed, unless nothing has failed."""
    return WITHOUT_FAULT.get(str(row["status"]), "bad")


def by_calibration(row: Row) -> str:
    """Mark cases that failed, and those that a solver was calibrated on."""
    return by_status(row) or ("out" if row["used_for_calibration"] else "")


def by_file_status(row: Row) -> str:
    """Mark files that are missing, not understood, not named or left out."""
    status = FileStatus(str(row["status"]))
    match status:
        case FileStatus.NOT_UNDERSTOOD | FileStatus.MISSING:
            return "bad"
        case FileStatus.NOT_NAMED:
            return "warn"
        case FileStatus.LEFT_OUT:
            return "out"
        case FileStatus.USED | FileStatus.REPEATED | FileStatus.NOTE | FileStatus.SHEET:
            return ""
        case _:
            assert_never(status)


def by_include(row: Row) -> str:
    """Mark specimens that the sheet leaves out."""
    return "out" if row["include"] == "no" else ""


def by_outliers(row: Row) -> str:
    """Mark groups with an outlying specimen."""
    return "warn" if row["outlier_specimens"] else ""


def by_origin(row: Row) -> str:
    """Mark constants that are assumed."""
    return "out" if row["origin"] == "assumed" else ""


def by_deviation(row: Row) -> str:
    """Mark deviations from a standard."""
    return "warn" if row["kind"] == "deviation" else ""


def of_specimens(left_out: Collection[str]) -> RowClass:
    """Mark properties of specimens that are left out, and properties that were not assessed."""

    def mark(row: Row) -> str:
        if row["specimen"] in left_out:
            return "out"
        return "warn" if str(row["flags"]).startswith("not assessed") else ""

    return mark
