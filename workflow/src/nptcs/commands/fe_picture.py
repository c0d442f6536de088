"""``nptcs fe-picture``: solve one tyre and draw it deformed."""

from __future__ import annotations

import argparse


def register(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Declare the command."""
    parser = subparsers.add_parser(
        "fe-picture",
        help="draw a finite element tyre under load",
        description="Solve one tyre with fe_tyre and the published ply constants, and draw it "
        "with all its spokes. The defaults are the published fiducial design.",
    )
    parser.add_argument("output", metavar="FIGURE", help=".png, .svg or .pdf")
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
    parser.set_defaults(run=run)


def run(arguments: argparse.Namespace) -> int:
    """Solve and draw."""
    from nptcs.config.fe import FeModel
    from nptcs.config.tyre import TyreGeometry
    from nptcs.fe.calibration import PUBLISHED_PLY
    from nptcs.fe.case import loaded_tyre, spoke_design, spoke_table, tyre_model
    from nptcs.fe.pictures import tyre_figure
    from nptcs.fe.spoke import SpokeModel
    from nptcs.files import atomic_path

    values = {
        "spacing_mm": arguments.spacing,
        "thickness_mm": arguments.thickness,
        "angle_deg": arguments.angle,
        "spoke_c10_mpa": arguments.spoke_c10,
    }
    model, dimensions = FeModel(), TyreGeometry()
    design = spoke_design(model, dimensions, PUBLISHED_PLY, values)
    tyre = tyre_model(model, dimensions, spoke_table(model, design), arguments.band_c10)
    state = loaded_tyre(tyre, model, arguments.load)
    figure = tyre_figure(tyre, state, SpokeModel(design))
    with atomic_path(arguments.output) as temporary:
        figure.savefig(temporary, dpi=150)
    print(
        f"{arguments.load:g} N at {state.rise_mm:.3f} mm: {arguments.load / state.rise_mm:.2f} N/mm"
    )
    return 0
