"""``nptcs deck``: write the input deck of a case for a solver that you have."""

from __future__ import annotations

import argparse
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING

from nptcs.arguments import add_card, add_command, existing_file, factor_type, output_file

if TYPE_CHECKING:
    from nptcs.config.solvers.tyre import TyreGeometry
    from nptcs.solvers.contract import CaseInputs

SOLVERS = ("abaqus", "calculix")


def register(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Declare the command."""
    parser = add_command(
        subparsers,
        "deck",
        "write the Abaqus or CalculiX deck of a case",
        "Write a complete, commented input deck of a case of a design table. Abaqus: "
        "the paper's whole tyre, loaded on a rigid plane. CalculiX: one axial period of a spoke "
        "with meshed plies, pulled by 4 mm and then compressed by 20 mm. docs/methods/decks.md "
        "describes both.",
        "nptcs deck results/4_design/plate.csv plate_032 -o spoke.inp --spoke-c10 1",
        "nptcs deck results/4_design/rubber.csv rubber_001 -o tyre.inp --solver abaqus "
        "--config config/config.yaml",
    )
    parser.add_argument(
        "design",
        type=existing_file,
        metavar="DESIGN.csv",
        help="design table with a column case_id, such as those in results/4_design",
    )
    parser.add_argument("case", metavar="CASE", help="its case_id")
    parser.add_argument(
        "-o",
        "--output",
        type=output_file(".inp"),
        metavar="OUT.inp",
        required=True,
        help="deck to write",
    )
    parser.add_argument("--solver", choices=SOLVERS, default="calculix", help="default: calculix")
    add_card(parser)
    parser.add_argument(
        "--config",
        type=existing_file,
        metavar="CONFIG.yaml",
        help="take tyre and solver options from here",
    )
    parser.add_argument(
        "--load",
        type=factor_type("load_n"),
        default=5000.0,
        help="load on the tyre (N; Abaqus only; 5000)",
    )
    for name, column, what in (
        ("spoke-c10", "spoke_c10_mpa", "spokes' C10 (MPa)"),
        ("band-c10", "shear_band_c10_mpa", "C10 of shear band and tread (MPa; Abaqus only)"),
        ("spacing", "spacing_mm", "plates' spacing (mm)"),
        ("thickness", "thickness_mm", "plates' thickness (mm)"),
        ("angle", "angle_deg", "plates' fibre angle (degrees)"),
    ):
        parser.add_argument(
            f"--{name}",
            type=factor_type(column),
            help=f"{what}, if the table has no such column",
        )
    parser.set_defaults(run=run)


def run(arguments: argparse.Namespace) -> int:
    """Write the deck."""
    from nptcs.files import write_text
    from nptcs.tables.laboratory.card_choice import choose_materials

    write = {"abaqus": _abaqus, "calculix": _calculix}[arguments.solver]
    materials = choose_materials(arguments.card, arguments.ply)
    inputs = _inputs(arguments, materials.ply)
    write_text(arguments.output, write(inputs))
    print(f"materials: {materials.source}")
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


def _inputs(arguments: argparse.Namespace, ply: Mapping[str, float]) -> CaseInputs:
    """Collect what the solver is given for the case."""
    from nptcs.solvers.contract import CaseInputs
    from nptcs.solvers.registry import MODULES, load_solver, read_options

    tyre, options = _configuration(arguments.config, arguments.solver)
    solver = load_solver(MODULES[arguments.solver])
    return CaseInputs(
        case_id=arguments.case,
        values=_values(arguments),
        load_n=arguments.load,
        tyre=tyre,
        options=read_options(solver, options),
        ply=ply,
    )


def _configuration(file: str | None, solver: str) -> tuple[TyreGeometry, Mapping[str, object]]:
    """Read the tyre and the solver's options; without a file, the defaults."""
    import yaml

    from nptcs.config.root import read_config
    from nptcs.config.solvers.tyre import TyreGeometry
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
            "choose a case_id that the table contains once",
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
    in_table = {name: _value(row[name], name, arguments) for name in given if name in row.index}
    return {name: value for name, value in given.items() if value is not None} | in_table


def _value(cell: object, name: str, arguments: argparse.Namespace) -> float:
    """Read one value of the case from the design table."""
    from nptcs.errors import InputError
    from nptcs.ranges import RANGES

    try:
        value = float(str(cell))
    except ValueError:
        value = float("nan")
    if fault := RANGES[name].fault(value):
        raise InputError(
            fault,
            "correct the design table",
            arguments.design,
            column=name,
            specimen=arguments.case,
            value=cell,
        )
    return value
