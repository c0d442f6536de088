"""``nptcs fe-picture``: solve one tyre or its spoke and draw it deformed."""

from __future__ import annotations

import argparse
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from typing import TYPE_CHECKING

from nptcs.arguments import FIGURES, add_card, add_command, factor_type, output_file
from nptcs.ranges import RANGES

if TYPE_CHECKING:
    from nptcs.config.solvers.tyre import TyreGeometry
    from nptcs.fe.spoke.equilibrium import SpokeModel
    from nptcs.fe.spoke.period import SpokeDesign
    from nptcs.fe.tyre.equilibrium import TyreModel, TyreState
    from nptcs.tables.laboratory.card_choice import ChosenMaterials

OPTIONS = {
    "spacing_mm": "--spacing",
    "thickness_mm": "--thickness",
    "angle_deg": "--angle",
    "spoke_c10_mpa": "--spoke-c10",
    "shear_band_c10_mpa": "--band-c10",
    "load_n": "--load",
}
"""Options of a design, by the columns that they set."""


def register(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Declare the command."""
    parser = add_command(
        subparsers,
        "fe-picture",
        "draw a finite element tyre under load, or its spoke",
        "Solve one tyre with fe_tyre, and draw it with all its spokes; or its single spoke, pulled "
        "by 4 mm and compressed by 20 mm, with the stress in rubber and fibres. The defaults are "
        "the published fiducial design; the ply is that of your card. A tyre takes about a minute.",
        "nptcs fe-picture tyre.png --thickness 2.4 --angle 30",
        "nptcs fe-picture spoke.svg --spoke --spoke-c10 rubber_75A",
    )
    parser.add_argument(
        "output", type=output_file(*FIGURES), metavar="FIGURE", help=".png, .svg or .pdf"
    )
    parser.add_argument("--spoke", action="store_true", help="draw the single spoke")
    add_design(parser)
    parser.set_defaults(run=run)


def add_design(parser: argparse.ArgumentParser) -> None:
    """Declare the options of a design and its materials."""
    for column, value, words in (
        ("spacing_mm", 15.0, "plate spacing S in mm"),
        ("thickness_mm", 1.8, "plate thickness T in mm"),
        ("angle_deg", 45.0, "fibre angle A in degrees"),
        ("load_n", 5000.0, "load on the tyre in N"),
    ):
        parser.add_argument(
            OPTIONS[column],
            type=factor_type(column),
            default=value,
            metavar="NUMBER",
            help=f"{words}, {RANGES[column]}; default: %(default)s",
        )
    for column, value, words in (
        ("spoke_c10_mpa", 1.0, "spokes"),
        ("shear_band_c10_mpa", 5.0, "shear band"),
    ):
        parser.add_argument(
            OPTIONS[column],
            type=c10_or_rubber,
            default=value,
            metavar="C10",
            help=f"C10 of the {words} in MPa, or the name of a rubber of the card; default: "
            "%(default)s",
        )
    add_card(parser)


def c10_or_rubber(text: str) -> float | str:
    """Read C10 in MPa, or the name of a rubber."""
    try:
        float(text)
    except ValueError:
        return text
    return factor_type("spoke_c10_mpa")(text)


@dataclass(frozen=True)
class SolvedTyre:
    """A loaded tyre, the model of its spokes, and where its materials are from."""

    dimensions: TyreGeometry
    tyre: TyreModel
    state: TyreState
    spoke: SpokeModel
    materials: str


def materials_of(arguments: argparse.Namespace) -> ChosenMaterials:
    """Read the card, fill in the C10 of rubbers given by name, and say which card it is."""
    from nptcs.tables.laboratory.card_choice import choose_materials

    materials = choose_materials(arguments.card, arguments.ply)
    arguments.spoke_c10 = materials.rubber(arguments.spoke_c10, "--spoke-c10")
    arguments.band_c10 = materials.rubber(arguments.band_c10, "--band-c10")
    print(f"materials: {materials.source}", flush=True)
    return materials


def design_of(arguments: argparse.Namespace, ply: Mapping[str, float]) -> SpokeDesign:
    """Return the spoke that the options describe.

    Raises
    ------
    InputError
        If a value of the design has no meaning.
    """
    from nptcs.config.solvers.fe import FeModel
    from nptcs.config.solvers.tyre import TyreGeometry
    from nptcs.errors import InputError
    from nptcs.fe.case import spoke_design
    from nptcs.solvers.contract import CaseInputs
    from nptcs.solvers.fe_inputs import TYRE_FACTORS, checked_values

    given = {
        "spacing_mm": arguments.spacing,
        "thickness_mm": arguments.thickness,
        "angle_deg": arguments.angle,
        "spoke_c10_mpa": arguments.spoke_c10,
        "shear_band_c10_mpa": arguments.band_c10,
    }
    model, tyre = FeModel(), TyreGeometry()
    inputs = CaseInputs("of the command line", given, arguments.load, tyre, model)
    try:
        values = checked_values(inputs, TYRE_FACTORS)
    except InputError as error:
        error.specimen, error.column = None, OPTIONS[str(error.column)]
        raise
    return spoke_design(model, tyre, ply, values)


def design_words(arguments: argparse.Namespace) -> str:
    """Write the design of the options for a reader."""
    return (
        f"S {arguments.spacing:g} mm, T {arguments.thickness:g} mm, A {arguments.angle:g}°, "
        f"C10 of spokes {arguments.spoke_c10:.4g} MPa, of band {arguments.band_c10:.4g} MPa"
    )


@contextmanager
def solvable() -> Iterator[None]:
    """Report in one line that a spoke or a tyre has no equilibrium, and how far it got.

    Raises
    ------
    InputError
    """
    from nptcs.errors import InputError
    from nptcs.fe.spoke.equilibrium import SpokeError
    from nptcs.fe.tyre.equilibrium import TyreError

    try:
        yield
    except (SpokeError, TyreError) as error:
        raise InputError(str(error), "choose a smaller load or another design") from error


def solved(arguments: argparse.Namespace) -> SolvedTyre:
    """Load the tyre that the options describe."""
    from nptcs.config.solvers.fe import FeModel
    from nptcs.config.solvers.tyre import TyreGeometry
    from nptcs.fe.case import energy_table, loaded_tyre, tyre_model
    from nptcs.fe.spoke.equilibrium import SpokeModel

    materials = materials_of(arguments)
    model, dimensions, design = FeModel(), TyreGeometry(), design_of(arguments, materials.ply)
    tyre = tyre_model(model, dimensions, energy_table(model, design), arguments.band_c10)
    state = loaded_tyre(tyre, model, arguments.load)
    print(
        f"{arguments.load:g} N at {state.rise_mm:.3f} mm: {arguments.load / state.rise_mm:.2f} N/mm"
    )
    return SolvedTyre(dimensions, tyre, state, SpokeModel(design), materials.source)


def run(arguments: argparse.Namespace) -> int:
    """Solve and draw."""
    from nptcs.fe.output.spoke_picture import spoke_figure
    from nptcs.fe.output.tyre_picture import tyre_figure
    from nptcs.fe.spoke.equilibrium import SpokeModel
    from nptcs.files import atomic_path

    with solvable():
        if arguments.spoke:
            materials = materials_of(arguments)
            source = materials.source
            figure = spoke_figure(SpokeModel(design_of(arguments, materials.ply)))
        else:
            case = solved(arguments)
            source = case.materials
            figure = tyre_figure(case.tyre, case.state, case.spoke)
    figure.suptitle(f"{design_words(arguments)}; {source}", fontsize=9)
    with atomic_path(arguments.output) as temporary:
        figure.savefig(temporary, dpi=150)
    return 0
