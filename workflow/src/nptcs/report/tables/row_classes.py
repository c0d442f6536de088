"""Which rows of a table are marked: ``bad`` failed, ``warn`` flagged, ``out`` left out."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping

Row = Mapping[str, object]
RowClass = Callable[[Row], str]

FILE_CLASSES = {"not understood": "bad", "missing": "bad", "not named": "warn", "left out": "out"}


def nothing(row: Row) -> str:
    """Mark no row."""
    return ""


def always_bad(row: Row) -> str:
    """Mark every row: a table of problems."""
    return "bad"


def by_status(row: Row) -> str:
    """Mark what did not end well."""
    return "" if row["status"] == "ok" else "bad"


def by_calibration(row: Row) -> str:
    """Mark cases that failed, and those that a solver was calibrated on."""
    return by_status(row) or ("out" if row["used_for_calibration"] else "")


def by_file_status(row: Row) -> str:
    """Mark files that are missing, not understood, not named or left out."""
    return FILE_CLASSES.get(str(row["status"]), "")


def by_include(row: Row) -> str:
    """Mark specimens that the sheet leaves out."""
    return "out" if row["include"] == "no" else ""


def by_outliers(row: Row) -> str:
    """Mark groups with an outlying specimen."""
    return "warn" if row["outlier_specimens"] else ""


def by_origin(row: Row) -> str:
    """Mark constants that are assumed."""
    return "out" if row["origin"] == "assumed" else ""


def of_specimens(left_out: Collection[str]) -> RowClass:
    """Mark properties of specimens that are left out, and properties that were not assessed."""

    def mark(row: Row) -> str:
        if row["specimen"] in left_out:
            return "out"
        return "warn" if str(row["flags"]).startswith("not assessed") else ""

    return mark
