"""How a column name with its unit, such as ``spoke_c10_mpa``, is written for a reader."""

from __future__ import annotations

from collections.abc import Mapping

from nptcs.language import tr
from nptcs.report.tables.response_titles import RESPONSE_TITLES
from nptcs.tables.result_table import Heading

UNITS = {
    "_n_per_mm2": "N/mm²",
    "_n_per_mm": "N/mm",
    "_mpa": "MPa",
    "_gpa": "GPa",
    "_mm2": "mm²",
    "_mm": "mm",
    "_deg": "°",
    "_percent": "%",
    "_c": "°C",
    "_bytes": "bytes",
    "_s": "s",
    "_n": "N",
    "_hz": "Hz",
}
"""Endings of column names, the longer ones first, and the units that they state."""

NAMES = {
    "c10": "C10",
    "e1": "E1",
    "e2": "E2",
    "e3": "E3",
    "g12": "G12",
    "g13": "G13",
    "g23": "G23",
    "nu12": "ν12",
    "nu13": "ν13",
    "nu23": "ν23",
    "nu21": "ν21",
    "nu31": "ν31",
    "nu32": "ν32",
    "r2": "R²",
    "vif": "VIF",
    "aicc": "AICc",
    "drucker": "Drucker",
    "sha256": "SHA-256",
    "lca": "LCA",
    "fem": "FEM",
    "rmse": "RMSE",
    "mnr": "MNR",
    "cv": "CV",
    "ci95": "95 % CI",
    "r": "R",
    "squared": "²",
    "theta": "θ",
    "ea": "EA",
    "ga": "GA",
    "ei": "EI",
    "b": "B",
}
"""Parts of column names that are written in another way."""


def heading(column: str, fixed: Mapping[str, Heading] | None = None) -> Heading:
    """Write a column name for a reader.

    Parameters
    ----------
    column : str
        Such as ``vertical_stiffness_n_per_mm``.
    fixed : mapping of str to Heading, optional
        Headings of columns whose names do not state the unit.

    Returns
    -------
    Heading
        Such as ``Heading('vertical stiffness', 'N/mm')``.
    """
    if fixed and column in fixed:
        given = fixed[column]
        return Heading(tr(given.name), tr(given.unit))
    for ending, unit in UNITS.items():
        if column.endswith(ending):
            return Heading(words(column.removesuffix(ending)), unit)
    return Heading(words(column))


def words(name: str) -> str:
    """Write ``leave_one_out_r_squared`` as ``leave one out R²``, and a response by its title."""
    if name in RESPONSE_TITLES:
        return tr(RESPONSE_TITLES[name])
    parts = [NAMES.get(part, part) for part in name.split("_")]
    return tr(" ".join(parts).replace("R ²", "R²").replace("θ c", "θc").replace("θ t", "θt"))
