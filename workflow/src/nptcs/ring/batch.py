"""A table of designs in, a table of results out, in parallel."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from concurrent.futures import ProcessPoolExecutor
from functools import partial
from math import ceil
from typing import Any, Protocol

import numpy as np
import pandas as pd
from pydantic import ValidationError
from threadpoolctl import threadpool_limits

from nptcs.config.solvers.ring import RingOptions
from nptcs.config.solvers.tyre import TyreGeometry
from nptcs.errors import InputError
from nptcs.fe.spoke.energy_table import SpokeEnergyTable
from nptcs.ring.kernel.compiled import Kernel
from nptcs.ring.responses import responses
from nptcs.ring.solution import RingError, SpokeRangeError, press_through_loads
from nptcs.ring.tyre import RingTyre, ring_tyre
from nptcs.tables.io import check
from nptcs.tables.tyres.ring import RingResults

REQUIRED = ("shear_band_c10_mpa", "load_n")
OPTIONAL = ("tread_c10_mpa", "spoke_factor", "friction")
DIMENSIONS = (
    "outer_diameter_mm",
    "rim_diameter_mm",
    "shear_band_thickness_mm",
    "inner_wire_diameter_mm",
    "outer_wire_diameter_mm",
    "spoke_count",
    "wire_layers",
    "wire_diameter_mm",
    "wire_pitch_mm",
    "wire_modulus_mpa",
    "wire_poisson_ratio",
)
"""Fields of `TyreGeometry` that a design may vary. The width is not among them: a spoke's table is
computed for a spoke as wide as its tyre."""
NUMBERS = (
    "displacement_mm",
    "displacement_standard_error_mm",
    "vertical_stiffness_n_per_mm",
    "tangent_stiffness_n_per_mm",
    "contact_length_mm",
    "largest_pressure_mpa",
    "smallest_u_r_mm",
    "largest_u_r_mm",
    "spoke_energy_n_mm",
    "band_energy_n_mm",
)
STEP_N = 500.0
"""Load steps are equal and no longer than this."""

Row = Mapping[str, Any]


class SpokeSource(Protocol):
    """Where the spoke of a design comes from: computed tables by name, or a surrogate."""

    columns: tuple[str, ...]

    def table(self, row: Row) -> SpokeEnergyTable:
        """Return the table for a row; ValueError where there is none."""
        ...

    def displacement_error_mm(
        self, row: Row, tyre: RingTyre, states: Sequence[Any], factor: float
    ) -> float:
        """Return the standard error of the last displacement that comes from the table."""
        ...


class NamedTables:
    """Computed energy tables by name, given in a column ``spoke``.

    Parameters
    ----------
    tables : mapping of str to SpokeEnergyTable
    """

    columns: tuple[str, ...] = ("spoke",)

    def __init__(self, tables: Mapping[str, SpokeEnergyTable]) -> None:
        self._tables = dict(tables)

    def table(self, row: Row) -> SpokeEnergyTable:
        """Return the table that the row names.

        Raises
        ------
        ValueError
            If there is no such table.
        """
        name = str(row["spoke"])
        if name not in self._tables:
            raise ValueError(f"there is no energy table for a spoke {name!r}")
        return self._tables[name]

    def displacement_error_mm(
        self, row: Row, tyre: RingTyre, states: Sequence[Any], factor: float
    ) -> float:
        """Return 0: a computed table has no error of prediction."""
        return 0.0


def known_columns(spokes: SpokeSource) -> tuple[str, ...]:
    """Name every column that is read."""
    return (*REQUIRED, *spokes.columns, *OPTIONAL, *DIMENSIONS)


def solve_table(
    table: pd.DataFrame,
    spokes: SpokeSource,
    tyre: TyreGeometry,
    options: RingOptions,
    workers: int = 1,
    kernel: Kernel | None = None,
) -> pd.DataFrame:
    """Solve every row of a table of designs.

    Parameters
    ----------
    table : DataFrame
        Columns `REQUIRED` and those of `spokes`; any of `OPTIONAL` and `DIMENSIONS` replaces the
        common value if the cell is not empty. Other columns are kept.
    spokes : SpokeSource
        Energy tables by name, or a surrogate.
    tyre : TyreGeometry
        The tyre that the designs of the table vary.
    options : RingOptions
    workers : int
        Number of processes; results do not depend on it.
    kernel : {"numpy", "numba"}, optional
        numba if it is installed.

    Returns
    -------
    DataFrame
        The same rows with the results of `RingResults`; a row that fails has a status and a
        message and no numbers.

    Raises
    ------
    InputError
        If a required column is missing, or a column has the name of a result or of a dimension of
        the tyre that a design cannot vary.
    """
    for column in sorted(set(TyreGeometry.model_fields) - set(DIMENSIONS)):
        if column in table:
            raise InputError(
                "a design on the ring cannot vary this dimension",
                f"drop the column; designs may vary {', '.join(DIMENSIONS)}",
                column=column,
            )
    for column in (*REQUIRED, *spokes.columns):
        if column not in table:
            raise InputError("column is missing", f"add {column}", column=column)
    for column in (*NUMBERS, "status", "message"):
        if column in table:
            raise InputError("this column is a result", "rename or drop it", column=column)
    rows = table.to_dict("records")
    one = partial(_solve_rows, spokes=spokes, tyre=tyre, options=options, kernel=kernel)
    if workers <= 1 or len(rows) <= 1:
        found = one(rows)
    else:
        size = ceil(len(rows) / (4 * workers))
        parts = [rows[start : start + size] for start in range(0, len(rows), size)]
        with ProcessPoolExecutor(workers) as pool:
            found = [result for part in pool.map(one, parts) for result in part]
    results = pd.DataFrame(found, columns=[*NUMBERS, "status", "message"], index=table.index)
    return check(pd.concat([table, results], axis=1), RingResults, "designs")


@threadpool_limits.wrap(limits=1)
def _solve_rows(
    rows: Sequence[Row],
    spokes: SpokeSource,
    tyre: TyreGeometry,
    options: RingOptions,
    kernel: Kernel | None,
) -> list[dict[str, Any]]:
    return [_solve_row(row, spokes, tyre, options, kernel) for row in rows]


def _solve_row(
    row: Row, spokes: SpokeSource, tyre: TyreGeometry, options: RingOptions, kernel: Kernel | None
) -> dict[str, Any]:
    """Give the result of one design; a failure is a status and a message."""
    try:
        numbers = _numbers(row)
        load_n = numbers["load_n"]
        if not load_n > 0.0:
            raise ValueError(f"load_n must be above zero, got {load_n:g}")
        factor = numbers.get("spoke_factor", 1.0)
        built = _tyre_of(numbers, spokes.table(row), tyre, options, kernel)
    except ValueError as error:
        return {"status": "bad_input", "message": _first_line(error)}
    steps = max(ceil(load_n / STEP_N), 2)
    try:
        states = press_through_loads(built, np.linspace(0.0, load_n, steps + 1)[1:].tolist())
    except SpokeRangeError as error:
        return {"status": "beyond_table", "message": str(error)}
    except RingError as error:
        return {"status": "diverged", "message": str(error)}
    last = states[-1]
    found = responses(built, last)
    return {
        "displacement_mm": last.rise_mm,
        "displacement_standard_error_mm": spokes.displacement_error_mm(row, built, states, factor),
        "vertical_stiffness_n_per_mm": load_n / last.rise_mm,
        **{name: found[name] for name in NUMBERS if name in found},
        "status": "ok",
        "message": "",
    }


def _first_line(error: ValueError) -> str:
    if isinstance(error, ValidationError):
        first = error.errors()[0]
        return f"{'.'.join(map(str, first['loc'])) or 'tyre'}: {first['msg']}"
    return str(error).splitlines()[0]


def _numbers(row: Row) -> dict[str, float]:
    """Cells of the known columns that are not empty, as numbers."""
    found: dict[str, float] = {}
    for name in (*REQUIRED, *OPTIONAL, *DIMENSIONS):
        cell = row.get(name)
        if cell is None or pd.isna(cell) or cell == "":
            if name in REQUIRED:
                raise ValueError(f"{name} is empty")
            continue
        try:
            found[name] = float(cell)
        except (TypeError, ValueError):
            raise ValueError(f"{name} is not a number: {cell!r}") from None
        if not np.isfinite(found[name]):
            raise ValueError(f"{name} must be finite, got {found[name]}")
    for name in ("shear_band_c10_mpa", "tread_c10_mpa", "spoke_factor"):
        if not found.get(name, 1.0) > 0.0:
            raise ValueError(f"{name} must be above zero, got {found[name]:g}")
    return found


def _tyre_of(
    numbers: Mapping[str, float],
    table: SpokeEnergyTable,
    tyre: TyreGeometry,
    options: RingOptions,
    kernel: Kernel | None,
) -> RingTyre:
    own = {name: numbers[name] for name in DIMENSIONS if name in numbers}
    if own:
        tyre = TyreGeometry.model_validate({**tyre.model_dump(), **own})
    if "friction" in numbers:
        contact = {**options.contact.model_dump(), "friction": numbers["friction"]}
        options = type(options).model_validate({**options.model_dump(), "contact": contact})
    return ring_tyre(
        tyre,
        table,
        numbers["shear_band_c10_mpa"],
        options,
        numbers.get("tread_c10_mpa"),
        numbers.get("spoke_factor", 1.0),
        kernel,
    )
