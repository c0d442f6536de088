"""``nptcs fe-picture``: solve one tyre or its spoke and draw it deformed."""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from nptcs.config.tyre import TyreGeometry
    from nptcs.fe.spoke.equilibrium import SpokeDesign, SpokeModel
    from nptcs.fe.tyre.equilibrium import TyreModel, TyreState


def register(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Declare the command."""
    parser = subparsers.add_parser(
        "fe-picture",
        help="draw a finite element tyre under load, or its spoke",
        description="Solve one tyre with fe_tyre and the published ply constants, and draw it "
        "with all its spokes; or its single spoke, pulled by 4 mm and pressed by 20 mm, with the "
        "stress in rubber and fibres. The defaults are the published fiducial design.",
    )
    parser.add_argument("output", metavar="FIGURE", help=".png, .svg or .pdf")
    parser.add_argument("--spoke", action="store_true", help="draw the single spoke")
    add_design(parser)
    parser.set_defaults(run=run)


def add_design(parser: argparse.ArgumentParser) -> None:
    """Declare the options of a design."""
    for name, value, unit in (
        ("spacing", 15.0, "mm"),
        ("thickness", 1.8, "mm"),
        ("angle", 45.0, "degrees"),
        ("spoke-c10", 1.0, "MPa"),
        ("band-c10", 5.0, "MPa"),
        ("load", 5000.0, "N"),
    ):
        parser.add_argument(
            f"--{name}", type=float, default=value, help=f"{unit} (default: %(default)s)"
        )


@dataclass(frozen=True)
class SolvedTyre:
    """A loaded tyre and the model of its spokes."""

    dimensions: TyreGeometry
    tyre: TyreModel
    state: TyreState
    spoke: SpokeModel


def design_of(arguments: argparse.Namespace) -> SpokeDesign:
    """Return the spoke that the options describe.

    Raises
    ------
    InputError
        If a value of the design has no meaning.
    """
    from nptcs.config.fe import FeModel
    from nptcs.config.tyre import TyreGeometry
    from nptcs.fe.case import spoke_design
    from nptcs.solvers.contract import CaseInputs
    from nptcs.solvers.fe_inputs import TYRE_FACTORS, checked_values
    from nptcs.tables.material_card import PUBLISHED_PLY

    given = {
        "spacing_mm": arguments.spacing,
        "thickness_mm": arguments.thickness,
        "angle_deg": arguments.angle,
        "spoke_c10_mpa": arguments.spoke_c10,
        "shear_band_c10_mpa": arguments.band_c10,
    }
    model, tyre = FeModel(), TyreGeometry()
    inputs = CaseInputs("of the command line", given, arguments.load, tyre, model)
    return spoke_design(model, tyre, PUBLISHED_PLY, checked_values(inputs, TYRE_FACTORS))


@contextmanager
def solvable() -> Iterator[None]:
    """Report in one line that a spoke or a tyre found no equilibrium, and how far it got.

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
    from nptcs.config.fe import FeModel
    from nptcs.config.tyre import TyreGeometry
    from nptcs.fe.case import energy_table, loaded_tyre, tyre_model
    from nptcs.fe.spoke.equilibrium import SpokeModel

    model, dimensions, design = FeModel(), TyreGeometry(), design_of(arguments)
    tyre = tyre_model(model, dimensions, energy_table(model, design), arguments.band_c10)
    state = loaded_tyre(tyre, model, arguments.load)
    print(
        f"{arguments.load:g} N at {state.rise_mm:.3f} mm: {arguments.load / state.rise_mm:.2f} N/mm"
    )
    return SolvedTyre(dimensions, tyre, state, SpokeModel(design))


def run(arguments: argparse.Namespace) -> int:
    """Solve and draw."""
    from nptcs.fe.output.spoke_picture import spoke_figure
    from nptcs.fe.output.tyre_picture import tyre_figure
    from nptcs.fe.spoke.equilibrium import SpokeModel
    from nptcs.files import atomic_path

    with solvable():
        if arguments.spoke:
            figure = spoke_figure(SpokeModel(design_of(arguments)))
        else:
            case = solved(arguments)
            figure = tyre_figure(case.tyre, case.state, case.spoke)
    with atomic_path(arguments.output) as temporary:
        figure.savefig(temporary, dpi=150)
    return 0
