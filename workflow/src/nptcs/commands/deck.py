"""``nptcs deck``: write the input deck of a case for a solver that you have."""

from __future__ import annotations

import argparse
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from nptcs.config.tyre import TyreGeometry
    from nptcs.solvers.contract import CaseInputs

SOLVERS = ("abaqus", "calculix")


def register(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Declare the command."""
    parser = subparsers.add_parser(
        "deck",
        help="write the Abaqus or CalculiX deck of a case",
        description="Write a complete, commented input deck of a case of a design table. Abaqus: "
        "the paper's whole tyre, loaded on a rigid plane. CalculiX: one axial period of a spoke "
        "with meshed plies, pulled by 4 mm and then pressed by 20 mm. docs/methods/decks.md "
        "describes both.",
    )
    parser.add_argument("design", metavar="DESIGN.csv", help="design table with a column case_id")
    parser.add_argument("case", metavar="CASE", help="its case_id")
    parser.add_argument("-o", "--output", metavar="OUT.inp", required=True)
    parser.add_argument("--solver", choices=SOLVERS, default="calculix", help="default: calculix")
    parser.add_argument("--card", metavar="CARD.json", required=True, help="material card")
    parser.add_argument("--ply", required=True, help="name of a ply of the card")
    parser.add_argument(
        "--config", metavar="CONFIG.yaml", help="take tyre and solver options from here"
    )
    parser.add_argument(
        "--load", type=float, default=5000.0, help="load on the tyre (N; Abaqus only; 5000)"
    )
    for name, what in (
        ("spoke-c10", "spokes' C10 (MPa)"),
        ("band-c10", "C10 of shear band and tread (MPa; Abaqus only)"),
        ("spacing", "plates' spacing (mm)"),
        ("thickness", "plates' thickness (mm)"),
        ("angle", "plates' fibre angle (degrees)"),
    ):
        parser.add_argument(
            f"--{name}", type=float, help=f"{what}, where the table has no such column"
        )
    parser.set_defaults(run=run)


def run(arguments: argparse.Namespace) -> int:
    """Write the deck."""
    from nptcs.files import write_text

    write = {"abaqus": _abaqus, "calculix": _calculix}[arguments.solver]
    inputs = _inputs(arguments)
    write_text(arguments.output, write(inputs))
    command = {"abaqus": "abaqus job={0} input={0} interactive", "calculix": "ccx {0}"}
    name = Path(arguments.output).stem
    print(f"{arguments.output}: run it with {command[arguments.solver].format(name)}")
    return 0


def _abaqus(inputs: CaseInputs) -> str:
    from nptcs.decks.abaqus.deck import tyre_deck
    from nptcs.solvers.fe_inputs import TYRE_FACTORS, checked_values, ply_constants

    values = checked_values(inputs, TYRE_FACTORS)
    ply = ply_constants(inputs)
    return tyre_deck(inputs.options, inputs.tyre, ply, values, inputs.load_n, inputs.case_id)


def _calculix(inputs: CaseInputs) -> str:
    from nptcs.decks.calculix import spoke_deck, true_thickness
    from nptcs.fe.case import spoke_design
    from nptcs.solvers.fe_inputs import SPOKE_FACTORS, checked_values, ply_constants

    values = checked_values(inputs, SPOKE_FACTORS)
    design = spoke_design(inputs.options, inputs.tyre, ply_constants(inputs), values)
    return spoke_deck(true_thickness(design), [4.0, -20.0])


def _inputs(arguments: argparse.Namespace) -> CaseInputs:
    """Collect what the solver is given for the case."""
    from nptcs.solvers.contract import CaseInputs
    from nptcs.solvers.registry import MODULES, load, read_options

    tyre, options = _configuration(arguments.config, arguments.solver)
    solver = load(MODULES[arguments.solver])
    return CaseInputs(
        case_id=arguments.case,
        values=_values(arguments),
        load_n=arguments.load,
        tyre=tyre,
        options=read_options(solver, options),
        ply=_ply(Path(arguments.card), arguments.ply),
    )


def _configuration(file: str | None, solver: str) -> tuple[TyreGeometry, Mapping[str, object]]:
    """Read the tyre and the solver's options; without a file, the defaults."""
    import yaml

    from nptcs.config.root import read_config
    from nptcs.config.tyre import TyreGeometry
    from nptcs.errors import InputError

    if file is None:
        return TyreGeometry(), {}
    try:
        content = yaml.safe_load(Path(file).read_text(encoding="utf-8"))
    except (OSError, yaml.YAMLError) as error:
        raise InputError(
            f"is not a YAML file: {error}", "give the name of a configuration file", file=file
        ) from error
    config = read_config(content, file)
    return config.tyre, config.solvers.get(solver, {})


def _values(arguments: argparse.Namespace) -> dict[str, float]:
    """Factor values of the case; values that the table lacks come from the command line."""
    import pandas as pd

    from nptcs.errors import InputError

    try:
        table = pd.read_csv(arguments.design, dtype={"case_id": str})
    except (OSError, pd.errors.ParserError, pd.errors.EmptyDataError) as error:
        raise InputError(
            f"is not a CSV table: {error}", "give the name of a design table", file=arguments.design
        ) from error
    found = table[table["case_id"] == arguments.case] if "case_id" in table else table.iloc[:0]
    if len(found) != 1:
        raise InputError(
            f"{len(found)} rows have this case_id",
            "choose a case_id that the table has once",
            file=arguments.design,
            column="case_id",
            value=arguments.case,
        )
    given = {
        "spoke_c10_mpa": arguments.spoke_c10,
        "shear_band_c10_mpa": arguments.band_c10,
        "spacing_mm": arguments.spacing,
        "thickness_mm": arguments.thickness,
        "angle_deg": arguments.angle,
    }
    row = found.iloc[0]
    values = {name: value for name, value in given.items() if value is not None}
    return values | {name: float(row[name]) for name in given if name in row.index}


def _ply(path: Path, name: str) -> dict[str, float]:
    """Constants of a ply of a material card."""
    from nptcs.errors import InputError
    from nptcs.files import read_model
    from nptcs.tables.material_card import MaterialCard

    card = read_model(path, MaterialCard, by_hand=True)
    if name not in card.plies:
        raise InputError(
            "the card does not have this ply",
            f"choose one of {', '.join(card.plies)}",
            path,
            value=name,
        )
    return card.plies[name].values()
