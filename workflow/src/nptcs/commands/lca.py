"""``nptcs lca``: the load-bearing model for a table of designs, or a figure of one of them."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from nptcs.arguments import FIGURES, add_command, existing_file, output_file, whole_number_type

if TYPE_CHECKING:
    import pandas

    from nptcs.config.solvers.tyre import TyreGeometry

SHOWN = ("displacement_mm", "stiffness_n_per_mm", "theta_c_deg", "mean_pressure_mpa")
"""Results that are printed; the file has all of them."""

DIGITS = 5
MOST_ROWS, MOST_GIVEN = 50, 6


def register(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Declare the command."""
    parser = add_command(
        subparsers,
        "lca",
        "solve the load-bearing model for a table of designs",
        "Solve the load-bearing model (LCA) for every row of a CSV table with the "
        "columns shear_band_c10_mpa, tension_n_per_mm, compression_n_per_mm (of one spoke) and "
        "load_n. Any dimension of the tyre (band_radius_mm, spoke_count, wire_pitch_mm, ...) and "
        "axial_stiffness_n, shear_stiffness_n, bending_stiffness_n_mm2, radius_mm, width_mm may "
        "be given in further columns. Prints the results; -o writes them with all their digits. "
        "Rows that fail are marked; the exit code is then 1.",
        "nptcs lca designs.csv",
        "nptcs lca designs.csv -o solved.csv --plot ring.svg --row 2",
    )
    parser.add_argument(
        "table", type=existing_file, metavar="TABLE.csv", help="designs, one per row"
    )
    parser.add_argument(
        "-o",
        "--output",
        type=output_file(".csv"),
        metavar="OUT.csv",
        help="write the same rows with all results",
    )
    parser.add_argument("--json", action="store_true", help="print JSON for programs")
    parser.add_argument(
        "--section",
        choices=("sandwich", "printed"),
        default="sandwich",
        help="section of the shear band: the physical one, or the one printed in the paper; "
        "default: %(default)s",
    )
    parser.add_argument(
        "--plot",
        type=output_file(*FIGURES),
        metavar="FIGURE",
        help="draw the deformed ring of one row (.svg, .png or .pdf)",
    )
    parser.add_argument(
        "--row",
        type=whole_number_type(1),
        default=1,
        help="row to draw, counted from 1; default: %(default)s",
    )
    parser.set_defaults(run=run)


def run(arguments: argparse.Namespace) -> int:
    """Solve, print, write, draw; exit code 1 if any row failed."""
    from nptcs.errors import InputError

    try:
        failed = _solve(arguments)
    except InputError as error:
        error.file = error.file or arguments.table
        raise
    return 1 if failed else 0


def _solve(arguments: argparse.Namespace) -> int:
    """Solve the table and write what was asked for; return the number of failed rows."""
    from nptcs.config.solvers.tyre import TyreGeometry
    from nptcs.files import atomic_path
    from nptcs.lca.design_table import known_columns, solve_table

    table = read_designs(Path(arguments.table))
    _check_row(arguments, len(table))
    tyre = TyreGeometry()
    result = solve_table(table, tyre, arguments.section)
    if spare := [str(name) for name in table if name not in known_columns()]:
        print(
            f"nptcs: columns copied to the output but not used: {', '.join(spare)}", file=sys.stderr
        )
    if arguments.output is not None:
        with atomic_path(arguments.output) as temporary:
            result.to_csv(temporary, index=False, lineterminator="\n")
    print(as_json(result) if arguments.json else as_text(result, list(map(str, table))))
    if arguments.plot is not None:
        _draw(table, tyre, arguments)
    return int((~result["status"].isin(["ok", "doubtful"])).sum())


def as_text(result: pandas.DataFrame, given: Sequence[str]) -> str:
    """Write solved designs for a reader: what distinguishes the rows, and the main results.

    Parameters
    ----------
    result : DataFrame
        As `nptcs.lca.design_table.solve_table` returns it.
    given : sequence of str
        Columns of the table of designs.
    """
    from nptcs.report.tables.headings import heading
    from nptcs.report.text import number_text
    from nptcs.text_table import text_table

    differ = [name for name in given if len(result[name].drop_duplicates()) > 1]
    names = [*(differ or given)[:MOST_GIVEN], *SHOWN]
    shown = result.head(MOST_ROWS)
    numeric = [shown[name].dtype.kind in "if" for name in names]
    rows = []
    for number, record in enumerate(shown[[*names, "status"]].to_dict("records"), start=1):
        cells = [
            number_text(float(record[name]), DIGITS) if is_number else _text(record[name])
            for name, is_number in zip(names, numeric, strict=True)
        ]
        rows.append([str(number), *cells, str(record["status"])])
    heads = [heading(name) for name in names]
    titles = [f"{head.name}\n({head.unit})" if head.unit else head.name for head in heads]
    table = text_table(["row", *titles, "status"], rows, [True, *numeric, False])
    lines = [table]
    if len(result) > len(shown):
        lines.append(f"… and {len(result) - len(shown):,} further rows; -o OUT.csv writes all")
    told = enumerate(shown["message"], start=1)
    lines += [f"row {place}: {message}" for place, message in told if message]
    counts = result["status"].value_counts()
    return "\n".join([*lines, ", ".join(f"{n:,} {status}" for status, n in counts.items())])


def _text(cell: object) -> str:
    """Write a cell of a column that is not all numbers; an empty cell, which is NaN, as no text."""
    return "" if isinstance(cell, float) and cell != cell else str(cell)


def as_json(result: pandas.DataFrame) -> str:
    """Write solved designs for a program: one object per row."""
    return str(result.to_json(orient="records", indent=1, force_ascii=False, double_precision=15))


def _check_row(arguments: argparse.Namespace, rows: int) -> None:
    """Refuse to draw a row that the table does not have, before anything is solved."""
    from nptcs.errors import InputError

    if arguments.plot is not None and arguments.row > rows:
        raise InputError(
            f"the table has {rows} rows",
            remedy="count from 1",
            column="--row",
            value=arguments.row,
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
