"""A table of designs as a laboratory writes it; what it leaves out is taken from the tyre."""

from __future__ import annotations

import numpy as np
import pandas as pd

from nptcs.arrays import Floating
from nptcs.config.solvers.tyre import TyreGeometry
from nptcs.errors import InputError
from nptcs.lca.batch import solve_batch
from nptcs.lca.section import SectionKind, ShearBandSection, section_stiffness
from nptcs.lca.single import solve
from nptcs.lca.spokes.linear import LinearSpokes
from nptcs.lca.state import LcaState

REQUIRED = ("shear_band_c10_mpa", "tension_n_per_mm", "compression_n_per_mm", "load_n")
SECTION_COLUMNS = (
    "axial_stiffness_n",
    "shear_stiffness_n",
    "bending_stiffness_n_mm2",
    "radius_mm",
    "width_mm",
)
"""Optional columns that replace what the tyre's dimensions give."""
RESULTS = (
    "displacement_mm",
    "theta_c_deg",
    "theta_t_deg",
    "stiffness_n_per_mm",
    "contact_force_n",
    "ring_force_n",
    "tangent_stiffness_n_per_mm",
    "mean_pressure_mpa",
    "lowest_pressure_mpa",
    "balance_residual",
    "status",
    "message",
)


def known_columns() -> tuple[str, ...]:
    """Return every column that the model reads: required, section, and the tyre's dimensions."""
    return (*REQUIRED, *SECTION_COLUMNS, *TyreGeometry.model_fields)


def solve_table(
    table: pd.DataFrame,
    tyre: TyreGeometry,
    kind: SectionKind = "sandwich",
    workers: int = 1,
) -> pd.DataFrame:
    """Solve every row of a table of designs.

    Parameters
    ----------
    table : DataFrame
        Columns `REQUIRED`; any of `SECTION_COLUMNS` and of the fields of `TyreGeometry` replaces
        the tyre's own value if a cell is not empty. Other columns are kept.
    tyre : TyreGeometry
        The tyre that the table's designs vary.
    kind : {"sandwich", "printed"}
        How the section follows from the dimensions.
    workers : int
        Threads.

    Returns
    -------
    DataFrame
        The same rows with `RESULTS`; a row that fails has a status and a message, no numbers.

    Raises
    ------
    InputError
        A required column is missing, or a column has the name of a result.
    """
    for column in REQUIRED:
        if column not in table:
            raise InputError("column is missing", remedy=f"add {column}", column=column)
    for column in RESULTS:
        if column in table:
            raise InputError(
                "this column has the name of a result", remedy="rename or drop it", column=column
            )
    values = {name: _numbers(table, name) for name in known_columns() if name in table}
    designs, largest = _designs(values, tyre, kind, len(table))
    batch = solve_batch(
        designs, load_n=values["load_n"], largest_displacement_mm=largest, workers=workers
    )
    unread = _unreadable(table, values)
    result = table.copy()
    for name in RESULTS[:-2]:
        result[name] = np.where(unread == "", batch.columns[name], np.nan)
    result["status"] = np.where(unread == "", batch.status, "bad_input")
    result["message"] = np.where(unread == "", np.array(batch.message, dtype=object), unread)
    return result


def solve_row(
    table: pd.DataFrame, row: int, tyre: TyreGeometry, kind: SectionKind = "sandwich"
) -> LcaState:
    """Solve one row of a table of designs, for its state at any point.

    Parameters
    ----------
    table, tyre, kind
        As in `solve_table`.
    row : int
        Row, counted from 0.

    Raises
    ------
    InputError
        The row cannot be read, or the model cannot carry it.
    """
    one = table.iloc[[row]]
    values = {name: _numbers(one, name) for name in known_columns() if name in one}
    if text := _unreadable(one, values)[0]:
        raise InputError(text, remedy="correct the cell", line=row + 2)
    designs, largest = _designs(values, tyre, kind, 1)
    numbers = {name: float(column[0]) for name, column in designs.items()}
    section = ShearBandSection(**{name: numbers[name] for name in SECTION_COLUMNS})
    spokes = LinearSpokes(
        numbers["tension_n_per_mm"], numbers["compression_n_per_mm"], int(numbers["spoke_count"])
    )
    load = float(values["load_n"][0])
    return solve(section, spokes, load_n=load, largest_displacement_mm=float(largest[0]))


def _numbers(table: pd.DataFrame, column: str) -> Floating:
    """Return a column as floats, NaN where a cell is empty or not a number."""
    return np.asarray(pd.to_numeric(table[column], errors="coerce"), dtype=float)


def _unreadable(table: pd.DataFrame, values: dict[str, Floating]) -> Floating:
    """Return, for each row, the first cell that is filled but not a number, or an empty text."""
    texts = np.full(len(table), "", dtype=object)
    for name, numbers in values.items():
        filled = table[name].notna().to_numpy()
        for row in np.flatnonzero(filled & np.isnan(numbers) & (texts == "")):
            texts[row] = f"{name} is not a number: {table[name].iloc[row]!r}"
    return texts


def _designs(
    values: dict[str, Floating], tyre: TyreGeometry, kind: SectionKind, rows: int
) -> tuple[dict[str, Floating], Floating]:
    """Columns of `nptcs.lca.batch.DESIGN_COLUMNS`, and the room between band and rim (mm)."""

    def column(name: str, default: float | Floating) -> Floating:
        given = values.get(name, np.full(rows, np.nan))
        return np.asarray(np.where(np.isnan(given), default, given))

    dimensions = {name: column(name, value) for name, value in tyre.model_dump().items()}
    stiffness = section_stiffness(dimensions, values["shear_band_c10_mpa"], kind)
    defaults = (*stiffness, dimensions["band_radius_mm"], dimensions["tread_width_mm"])
    designs = {
        name: column(name, default) for name, default in zip(SECTION_COLUMNS, defaults, strict=True)
    }
    designs["tension_n_per_mm"] = values["tension_n_per_mm"]
    designs["compression_n_per_mm"] = values["compression_n_per_mm"]
    designs["spoke_count"] = dimensions["spoke_count"]
    return designs, designs["radius_mm"] - dimensions["rim_diameter_mm"] / 2
