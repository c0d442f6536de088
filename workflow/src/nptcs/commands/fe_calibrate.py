"""``nptcs fe-calibrate``: fit the spoke's section to table 10 and named cases of table 5."""

from __future__ import annotations

import argparse
from functools import partial
from typing import TYPE_CHECKING, get_args

from nptcs.arguments import (
    add_command,
    existing_file,
    factor_type,
    output_folder,
    whole_number_type,
)
from nptcs.config.solvers.fe import AxialFreedom, RingKind

if TYPE_CHECKING:
    import pandas

    from nptcs.fe.calibration import CalibrationProblem, CalibrationRound

# fiducial, and the corners of spacing with the softest and the stiffest plates
CASES = (32, 49, 15, 7, 57)
C10_MPA = (1, 5)
COLUMNS = {
    "table10": (
        "spoke_c10_mpa",
        "tension_stiffness_n_per_mm",
        "compression_stiffness_n_per_mm",
    ),
    "table5": ("case", "spacing_mm", "thickness_mm", "angle_deg", "stiffness_n_per_mm"),
}


def register(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Declare the command."""
    parser = add_command(
        subparsers,
        "fe-calibrate",
        "fit the finite element spoke's section to published stiffness",
        "Fit the dimensions of the spoke, which the paper shows only in a drawing, to table 10 "
        "(C10 1 and 5) and to at most five named cases of table 5. Prints the stiffnesses of each "
        "round with their targets, then ring and section as JSON for the options of fe_tyre and "
        "fe_spoke.",
        "nptcs fe-calibrate raw_data/published/table10_spoke_stiffness.csv "
        "raw_data/published/table5_plate_doe.csv",
    )
    parser.add_argument(
        "table10",
        type=existing_file,
        metavar="TABLE10.csv",
        help="the paper's table 10: stiffness of single spokes",
    )
    parser.add_argument(
        "table5",
        type=existing_file,
        metavar="TABLE5.csv",
        help="the paper's table 5: stiffness of tyres by plate design",
    )
    parser.add_argument(
        "--cases",
        type=whole_number_type(1),
        nargs="+",
        default=CASES,
        help="cases of table 5, at most five",
    )
    parser.add_argument(
        "--rounds",
        type=whole_number_type(1, 50),
        default=2,
        help="Gauss–Newton steps (default: %(default)s)",
    )
    parser.add_argument(
        "--workers", type=whole_number_type(1), default=2, help="processes (default: %(default)s)"
    )
    parser.add_argument(
        "--band-c10",
        type=factor_type("shear_band_c10_mpa"),
        default=5.0,
        help="C10 of the band in table 5, which does not state it (MPa; default: %(default)s)",
    )
    parser.add_argument(
        "--spoke-c10",
        type=factor_type("spoke_c10_mpa"),
        default=1.04,
        help="C10 of the spokes in table 5, which does not state it (MPa; default: %(default)s)",
    )
    parser.add_argument(
        "--ring",
        choices=get_args(RingKind),
        default="converged",
        help="ring of the tyres; the fitted section is valid only with this ring (default: "
        "%(default)s)",
    )
    parser.add_argument(
        "--axial",
        choices=get_args(AxialFreedom),
        help="freedom of band and tread along the axis (default: free_edges)",
    )
    parser.add_argument(
        "--spoke-cache",
        type=output_folder,
        help="folder in which runs share the tables of equal spokes",
    )
    parser.set_defaults(run=run)


def run(arguments: argparse.Namespace) -> int:
    """Calibrate and print.

    Raises
    ------
    InputError
        As `build_problem`, and if a spoke or a tyre cannot be loaded.
    """
    from nptcs.errors import InputError
    from nptcs.fe.calibration import calibrate
    from nptcs.fe.spoke.equilibrium import SpokeError
    from nptcs.fe.tyre.equilibrium import TyreError

    problem = build_problem(arguments)
    report = partial(_report, problem)
    try:
        model = calibrate(problem, arguments.rounds, arguments.workers, report)
    except (SpokeError, TyreError) as error:
        raise InputError(
            str(error), "choose stiffer rubbers (--band-c10, --spoke-c10) or other --cases"
        ) from error
    print(model.model_dump_json(include={"ring", "geometry"}, indent=2))
    return 0


def build_problem(arguments: argparse.Namespace) -> CalibrationProblem:
    """Read the targets.

    Raises
    ------
    InputError
        If a table lacks a column or a case, or more than five cases are named.
    """
    from nptcs.config.solvers.fe import FeModel
    from nptcs.config.solvers.tyre import TyreGeometry
    from nptcs.errors import InputError
    from nptcs.fe.calibration import START, CalibrationProblem, SpokeTarget, TyreTarget
    from nptcs.tables.laboratory.material_card import PUBLISHED_PLY

    if len(arguments.cases) > 5:
        raise InputError(
            "more than five cases of table 5 leave too few to predict",
            "name at most five",
            column="--cases",
            value=list(arguments.cases),
        )
    spokes = _read(arguments.table10, COLUMNS["table10"]).set_index("spoke_c10_mpa")
    tyres = _read(arguments.table5, COLUMNS["table5"]).set_index("case")
    for file, table, wanted, remedy in (
        (arguments.table5, tyres, arguments.cases, "choose other --cases"),
        (arguments.table10, spokes, C10_MPA, "give a table with these spokes"),
    ):
        if missing := sorted(set(wanted) - set(table.index)):
            raise InputError(
                "the table does not have these rows",
                remedy,
                file=file,
                column=str(table.index.name),
                value=missing,
            )
    fiducial = {"spacing_mm": 15.0, "thickness_mm": 1.8, "angle_deg": 45.0}
    k_t, k_c = (spokes[name].astype(float).to_dict() for name in COLUMNS["table10"][1:])
    rubbers = {"shear_band_c10_mpa": arguments.band_c10, "spoke_c10_mpa": arguments.spoke_c10}
    start = START.model_copy(update={"calibrated_with": arguments.ring})
    options = {"ring": arguments.ring}
    if arguments.axial is not None:
        options["axial"] = arguments.axial
    return CalibrationProblem(
        FeModel(**options).model_copy(update={"geometry": start}),
        TyreGeometry(),
        PUBLISHED_PLY,
        tuple(
            SpokeTarget(
                {**fiducial, "spoke_c10_mpa": float(c10)},
                k_t[c10],
                k_c[c10],
            )
            for c10 in C10_MPA
        ),
        tuple(
            TyreTarget(
                {**{name: float(tyres.loc[case, name]) for name in fiducial}, **rubbers},
                float(tyres.loc[case, "stiffness_n_per_mm"]),
            )
            for case in arguments.cases
        ),
        5000.0,
        arguments.spoke_cache,
    )


def _read(path: str, columns: tuple[str, ...]) -> pandas.DataFrame:
    import pandas as pd

    from nptcs.errors import InputError

    try:
        table = pd.read_csv(path)
    except (OSError, pd.errors.ParserError, pd.errors.EmptyDataError) as error:
        raise InputError(
            f"is not a CSV table: {error}", "give the name of a published table", file=path
        ) from error
    lacking = [name for name in columns if name not in table.columns]
    if lacking:
        raise InputError(
            "the table lacks columns", "give the table of the paper", file=path, value=lacking
        )
    return table


def _report(problem: CalibrationProblem, state: CalibrationRound) -> None:
    """Print one round: dimensions, then computed stiffnesses with their targets."""
    import numpy as np

    from nptcs.fe.calibration import FREE

    pairs = zip(FREE, np.exp(state.free), strict=True)
    print("section: " + ", ".join(f"{name} {value:.3f}" for name, value in pairs), flush=True)
    for target, (tension, compression) in zip(problem.spokes, state.spoke_stiffness, strict=True):
        print(
            f"  spoke C10 {target.values['spoke_c10_mpa']:g}: k_t {tension:.2f} "
            f"(target {target.tension_n_per_mm:g}), k_c {compression:.2f} "
            f"(target {target.compression_n_per_mm:g}) N/mm"
        )
    for case, stiffness in zip(problem.tyres, state.tyre_stiffness, strict=True):
        wanted, values = case.stiffness_n_per_mm, case.values
        print(
            f"  tyre S {values['spacing_mm']:g} T {values['thickness_mm']:g} "
            f"A {values['angle_deg']:g}: K {stiffness:.2f} (target {wanted:g}) N/mm, "
            f"{100.0 * (stiffness / wanted - 1.0):+.2f} %",
            flush=True,
        )
