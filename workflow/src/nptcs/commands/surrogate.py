"""``nptcs surrogate``: predicted spokes for the fast ring, with their errors."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING, Any

from nptcs.arguments import (
    add_command,
    existing_file,
    existing_folder,
    output_file,
    whole_number_type,
)

if TYPE_CHECKING:
    from nptcs.ring.surrogate.stored import StoredSurrogate

FILE = "results/5_solve/surrogate.json"


def register(subparsers: Any) -> None:
    """Declare the two actions."""
    parser = add_command(
        subparsers,
        "surrogate",
        "predict spokes' energy tables for the fast ring",
        "Fits a predictor of spokes' energy tables to those of a study, or solves a "
        "table of designs on predicted spokes in milliseconds each. Designs that are chosen in the "
        "end should be solved with computed tables.",
        "nptcs surrogate fit joint",
        "nptcs surrogate solve designs.csv -o solved.csv",
    )
    actions = parser.add_subparsers(required=True, metavar="ACTION", title="actions")
    fit = add_command(
        actions,
        "fit",
        "fit the predictor to the spokes of a study and test it on spokes left out",
        "Takes the spokes of the study's design from the folder of tables (and "
        "computes those that are missing), prints the errors of the tyre's displacement on spokes "
        "that were left out, and names the spoke whose table would help most.",
        "nptcs surrogate fit joint",
    )
    fit.add_argument("study", help="study of the solver ring, e.g. joint")
    fit.add_argument(
        "--config",
        nargs="+",
        type=existing_file,
        default=["config/config.yaml", "config/joint.yaml"],
        metavar="FILE",
        help="configuration files; later files override earlier ones; default: %(default)s",
    )
    fit.add_argument(
        "--results",
        type=existing_folder,
        default=Path("results"),
        help="folder of the run's results; default: %(default)s",
    )
    fit.add_argument(
        "-o", "--output", type=output_file(".json"), default=FILE, help="default: %(default)s"
    )
    fit.set_defaults(run=run_fit)
    solve = add_command(
        actions,
        "solve",
        "solve a table of designs on predicted spokes",
        "A row has plate_count, thickness_mm, angle_deg, spoke_c10_mpa, shear_band_c10_mpa and "
        "load_n; tread_c10_mpa, friction and dimensions of the tyre are optional. A row outside "
        "the box of the fitted spokes is not solved; its status and message say so.",
        "nptcs surrogate solve designs.csv -o solved.csv -j 2",
    )
    solve.add_argument(
        "table", type=existing_file, metavar="TABLE.csv", help="designs, one per row"
    )
    solve.add_argument(
        "-o",
        "--output",
        type=output_file(".csv"),
        metavar="OUT.csv",
        required=True,
        help="file to write: the same rows with the results",
    )
    solve.add_argument("--surrogate", default=FILE, help="default: %(default)s")
    solve.add_argument(
        "-j",
        "--workers",
        type=whole_number_type(1),
        default=1,
        help="processes; default: %(default)s",
    )
    solve.set_defaults(run=run_solve)


def run_fit(arguments: argparse.Namespace) -> int:
    """Fit, test, write."""
    import numpy as np

    from nptcs.files import write_text
    from nptcs.ring.surrogate.left_out import left_out_spokes
    from nptcs.ring.surrogate.model import DESIGN
    from nptcs.ring.surrogate.stored import dump_surrogate

    stored = _fitted(arguments)
    surrogate = stored.surrogate
    write_text(arguments.output, dump_surrogate(stored))
    found = left_out_spokes(surrogate, stored.tyre, stored.model)
    inner = np.logical_not(found.edge)
    print(f"{len(surrogate.tables)} spokes, s from {surrogate.tables[0].low[0]:.3g} mm")
    for spoke in surrogate.unfitted:
        named = dict(zip(DESIGN, spoke.tolist(), strict=True))
        print(f"not fitted, because it loses its stability early: {_words(named)}")
    print("displacement on spokes left out, a tenth at a time, 1500 to 5000 N:")
    print(f"  all      rms {found.rms():.3f} %, largest {found.largest():.3f} %")
    if inner.any():
        print(
            f"  {int(inner.sum())} not on a face of the others' box: rms {found.rms(inner):.3f} %, "
            f"largest {found.largest(inner):.3f} %"
        )
    worst = found.worst()
    named = dict(zip(DESIGN, surrogate.designs[worst].tolist(), strict=True))
    print(
        f"  largest at {_words(named)}: {abs(found.standard_errors[worst]):.1f} standard errors of "
        f"its prediction, {'on' if found.edge[worst] else 'not on'} a face of the others' box"
    )
    design, gain = surrogate.next_design()
    print(f"spoke that would help most next: {_words(design)} ({100 * gain:.0f} % of variance)")
    print(f"written: {arguments.output}")
    return 0


def _words(design: dict[str, float]) -> str:
    return ", ".join(f"{name} {value:.4g}" for name, value in design.items())


def _fitted(arguments: argparse.Namespace) -> StoredSurrogate:
    """Read the study's spokes and fit the surrogate to them."""
    from nptcs.calibrate.plan import ply_of
    from nptcs.config.files import read_config_files
    from nptcs.errors import InputError
    from nptcs.files import read_model
    from nptcs.ring.surrogate.collect import fit_surrogate
    from nptcs.ring.surrogate.stored import StoredSurrogate
    from nptcs.solvers.ring import RingSolverOptions
    from nptcs.tables.io import read_table
    from nptcs.tables.laboratory.material_card import PlyCard
    from nptcs.tables.laboratory.specimens import read_sheet
    from nptcs.tables.tyres.cases import DesignTable

    config = read_config_files(arguments.config)
    known = [study.name for study in config.studies if "ring" in study.solvers]
    if arguments.study not in known:
        raise InputError(
            "this study is not solved by the solver ring",
            value=arguments.study,
            remedy=f"name one of: {', '.join(known) or 'none in these files'}",
        )
    study, results = config.study(arguments.study), Path(arguments.results)
    options = RingSolverOptions.model_validate(config.options_of(study.name, "ring"))
    specimens, _ = read_sheet(config.lab_data.specimen_sheet)
    ply = ply_of(study, specimens, config.calibration)
    card = read_model(results / f"3_calibrate/{ply}.json", PlyCard)
    designs = read_table(results / f"4_design/{study.name}.csv", DesignTable)
    fitted = fit_surrogate(designs, options, config.tyre, card.values(), options.spoke_cache)
    return StoredSurrogate(fitted, config.tyre, options, study.name)


def run_solve(arguments: argparse.Namespace) -> int:
    """Solve and write; exit code 1 if a row failed."""
    import pandas as pd

    from nptcs.errors import InputError
    from nptcs.ring.batch import solve_table
    from nptcs.ring.surrogate.source import PredictedSpokes
    from nptcs.ring.surrogate.stored import read_surrogate

    stored = read_surrogate(arguments.surrogate)
    try:
        table = pd.read_csv(arguments.table)
    except (OSError, ValueError) as error:
        raise InputError(f"cannot be read: {error}", file=arguments.table) from None
    spokes = PredictedSpokes(stored.surrogate)
    solved = solve_table(table, spokes, stored.tyre, stored.model, arguments.workers)
    solved.to_csv(arguments.output, index=False)
    failed = solved[solved["status"] != "ok"]
    print(f"{len(solved)} designs, {len(failed)} without a result: {arguments.output}")
    first = zip(failed.index.tolist(), failed["status"], failed["message"], strict=True)
    for number, status, message in list(first)[:5]:
        print(f"  row {number + 1}: {status}: {message}")
    return 1 if len(failed) else 0
