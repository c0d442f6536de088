"""``nptcs lca``: the load-bearing model for a table of designs, or a figure of one of them."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import pandas

    from nptcs.config.tyre import TyreGeometry


def register(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Declare the command."""
    parser = subparsers.add_parser(
        "lca",
        help="solve the load-bearing model for a table of designs",
        description="Solve the load-bearing model (LCA) for every row of a CSV table with the "
        "columns shear_band_c10_mpa, tension_n_per_mm, compression_n_per_mm (of one spoke) and "
        "load_n. Any dimension of the tyre (band_radius_mm, spoke_count, wire_pitch_mm, ...) and "
        "axial_stiffness_n, shear_stiffness_n, bending_stiffness_n_mm2, radius_mm, width_mm may "
        "be given in further columns. Rows that fail are marked; the exit code is then 1.",
    )
    parser.add_argument("table", metavar="TABLE.csv", help="designs, one per row")
    parser.add_argument("-o", "--output", metavar="OUT.csv", help="the same rows with results")
    parser.add_argument(
        "--section",
        choices=("sandwich", "printed"),
        default="sandwich",
        help="section of the shear band: the physical one, or the one printed in the paper",
    )
    parser.add_argument(
        "--plot", metavar="FIGURE", help="draw the deformed ring of one row (.svg, .png or .pdf)"
    )
    parser.add_argument(
        "--row", type=int, default=1, help="row to draw, counted from 1 (default: %(default)s)"
    )
    parser.set_defaults(run=run)


def run(arguments: argparse.Namespace) -> int:
    """Solve, write, draw; exit code 1 if any row failed."""
    from nptcs.errors import InputError

    if arguments.output is None and arguments.plot is None:
        raise InputError("nothing to write", remedy="give -o OUT.csv, --plot FIGURE or both")
    try:
        failed = _solve(arguments)
    except InputError as error:
        error.file = error.file or arguments.table
        raise
    return 1 if failed else 0


def _solve(arguments: argparse.Namespace) -> int:
    """Solve the table and write what was asked for; return the number of failed rows."""
    from nptcs.config.tyre import TyreGeometry
    from nptcs.files import atomic_path
    from nptcs.lca.design_table import known_columns, solve_table

    table = read_designs(Path(arguments.table))
    _check_figure(arguments, len(table))
    tyre = TyreGeometry()
    result = solve_table(table, tyre, arguments.section)
    if spare := [str(name) for name in table if name not in known_columns()]:
        print(
            f"nptcs: columns copied to the output but not used: {', '.join(spare)}", file=sys.stderr
        )
    if arguments.output is not None:
        with atomic_path(arguments.output) as temporary:
            result.to_csv(temporary, index=False, lineterminator="\n")
    counts = result["status"].value_counts()
    print(", ".join(f"{count} {status}" for status, count in counts.items()))
    if arguments.plot is not None:
        _draw(table, tyre, arguments)
    return int((~result["status"].isin(["ok", "doubtful"])).sum())


def _check_figure(arguments: argparse.Namespace, rows: int) -> None:
    """Refuse a drawing that cannot be made, before anything is solved."""
    from nptcs.errors import InputError
    from nptcs.lca.plot import FORMATS

    if arguments.plot is None:
        return
    if not 1 <= arguments.row <= rows:
        raise InputError(
            f"the table has {rows} rows",
            remedy="count from 1",
            column="--row",
            value=arguments.row,
        )
    if Path(arguments.plot).suffix not in FORMATS:
        raise InputError(
            "unknown kind of figure",
            remedy=f"use a name that ends in {', '.join(FORMATS)}",
            column="--plot",
            value=arguments.plot,
        )


def _draw(table: pandas.DataFrame, tyre: TyreGeometry, arguments: argparse.Namespace) -> None:
    """Draw the ring of one row."""
    from nptcs.files import atomic_path
    from nptcs.lca.design_table import solve_row
    from nptcs.lca.plot import ring_figure

    figure = ring_figure(solve_row(table, arguments.row - 1, tyre, arguments.section))
    with atomic_path(arguments.plot) as temporary:
        figure.savefig(temporary, dpi=150)


def read_designs(path: Path) -> pandas.DataFrame:
    """Read a table of designs.

    Raises
    ------
    InputError
        The file is missing, empty or not a table.
    """
    import pandas as pd

    from nptcs.errors import InputError

    if not path.is_file():
        raise InputError(
            "this file does not exist", file=path, remedy="give the name of a CSV table"
        )
    try:
        table = pd.read_csv(path)
    except (pd.errors.ParserError, pd.errors.EmptyDataError, UnicodeDecodeError) as error:
        raise InputError(
            f"is not a CSV table: {error}", file=path, remedy="save it as CSV"
        ) from error
    if table.empty:
        raise InputError("the table has no rows", file=path, remedy="give at least one design")
    return table
