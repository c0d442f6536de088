"""``nptcs deck``: write a case's input deck for a solver that the user owns."""

from __future__ import annotations

import argparse
from pathlib import Path


def register(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Declare the command."""
    parser = subparsers.add_parser(
        "deck",
        help="write the CalculiX deck of a case's spoke",
        description="Write a complete CalculiX deck of one spoke of a design table: one axial "
        "period with meshed plies, pulled by 4 mm and then pressed by 20 mm.",
    )
    parser.add_argument("design", metavar="DESIGN.csv", help="design table with a column case_id")
    parser.add_argument("case", metavar="CASE", help="its case_id")
    parser.add_argument("-o", "--output", metavar="OUT.inp", required=True)
    parser.add_argument("--card", metavar="CARD.json", required=True, help="material card")
    parser.add_argument("--ply", required=True, help="name of a ply of the card")
    parser.add_argument(
        "--spoke-c10", type=float, help="spokes' C10 (MPa), where the table has none"
    )
    for name, unit in (("spacing", "mm"), ("thickness", "mm"), ("angle", "degrees")):
        parser.add_argument(
            f"--{name}", type=float, help=f"plates' {name} ({unit}), where the table has none"
        )
    parser.set_defaults(run=run)


def run(arguments: argparse.Namespace) -> int:
    """Write the deck."""
    from nptcs.config.tyre import TyreGeometry
    from nptcs.fe.calculix import spoke_deck, true_thickness
    from nptcs.fe.case import spoke_design
    from nptcs.files import write_text
    from nptcs.solvers.calculix import CalculixOptions
    from nptcs.solvers.contract import CaseInputs
    from nptcs.solvers.fe_inputs import SPOKE_FACTORS, checked_values

    tyre, options = TyreGeometry(), CalculixOptions()
    inputs = CaseInputs(arguments.case, _values(arguments), 0.0, tyre, options)
    values = checked_values(inputs, SPOKE_FACTORS)
    design = spoke_design(options, tyre, _ply(Path(arguments.card), arguments.ply), values)
    write_text(arguments.output, spoke_deck(true_thickness(design), [4.0, -20.0]))
    print(f"{arguments.output}: run it with ccx {Path(arguments.output).stem}")
    return 0


def _values(arguments: argparse.Namespace) -> dict[str, float]:
    """Factor values of the case, completed by the command line."""
    import pandas as pd

    from nptcs.errors import InputError

    try:
        table = pd.read_csv(arguments.design, dtype={"case_id": str})
    except (OSError, pd.errors.ParserError, pd.errors.EmptyDataError) as error:
        raise InputError(
            f"no CSV table: {error}", "name a design table", file=arguments.design
        ) from error
    found = table[table["case_id"] == arguments.case] if "case_id" in table else table.iloc[:0]
    if len(found) != 1:
        raise InputError(
            f"{len(found)} rows have this case_id",
            "name one case of the table",
            file=arguments.design,
            column="case_id",
            value=arguments.case,
        )
    given = {
        "spoke_c10_mpa": arguments.spoke_c10,
        "spacing_mm": arguments.spacing,
        "thickness_mm": arguments.thickness,
        "angle_deg": arguments.angle,
    }
    row = found.iloc[0]
    values = {name: value for name, value in given.items() if value is not None}
    return values | {name: float(row[name]) for name in given if name in row.index}


def _ply(path: Path, name: str) -> dict[str, float]:
    """Constants of a ply of a material card."""
    from pydantic import ValidationError

    from nptcs.errors import InputError
    from nptcs.materials import MaterialCard

    try:
        card = MaterialCard.model_validate_json(path.read_text(encoding="utf-8"))
    except (OSError, ValidationError) as error:
        raise InputError(
            f"no material card: {error}", "name the card's JSON file", file=path
        ) from error
    if name not in card.plies:
        raise InputError(
            "the card has no such ply", f"name one of {', '.join(card.plies)}", path, value=name
        )
    return card.plies[name].values()
