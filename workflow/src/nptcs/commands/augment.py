"""``nptcs augment``: propose further cases of a study where a surface is least certain."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any

from nptcs.arguments import add_command, existing_file, existing_folder, whole_number_type


def register(subparsers: Any) -> None:
    """Declare the arguments."""
    parser = add_command(
        subparsers,
        "augment",
        "propose further cases where a surface is least certain",
        "Prints cases for the key `further_cases` of the study, each where the "
        "prediction interval is widest once the cases before it are added. The study must have "
        "been run.",
        "nptcs augment plate --solver fe_tyre_paper --cases 3",
    )
    parser.add_argument("study", help="name of the study")
    parser.add_argument("--solver", required=True, help="solver whose surface is used")
    parser.add_argument("--surface", default="polynomial", help="surface; default: %(default)s")
    parser.add_argument(
        "--cases", type=whole_number_type(1, 100), default=5, help="how many; default: %(default)s"
    )
    parser.add_argument(
        "--config",
        type=existing_file,
        default="config/config.yaml",
        help="configuration with the tyre, for --whole-plates; default: %(default)s",
    )
    parser.add_argument(
        "--models",
        type=existing_folder,
        default="results/6_surface/models",
        help="folder of the fitted surfaces; default: %(default)s",
    )
    parser.add_argument(
        "--whole-plates",
        action="store_true",
        help="only spacings at which a spoke has a whole number of plates",
    )
    parser.set_defaults(run=run)


def run(arguments: argparse.Namespace) -> int:
    """Print the cases as YAML, with the half width of the interval at each."""
    import yaml

    from nptcs.config.root import read_config
    from nptcs.doe.augment import augment, candidates_in_box
    from nptcs.errors import InputError
    from nptcs.surface.stored import read_models

    file = arguments.models / f"{arguments.study}.json"
    if not file.is_file():
        raise InputError(
            "this study has no fitted surfaces", file=file, remedy="run snakemake first"
        )
    models = read_models(file)
    if arguments.solver not in models:
        raise InputError(
            "the study has no surface for this solver",
            f"name one of: {', '.join(models) or 'none was fitted'}",
            file,
            column="--solver",
            value=arguments.solver,
        )
    fitted = models[arguments.solver]
    if arguments.surface not in fitted:
        raise InputError(
            f"solver {arguments.solver} has no such surface",
            file=file,
            value=arguments.surface,
            remedy=f"name one of: {', '.join(fitted) or 'none was fitted'}",
        )
    surface = fitted[arguments.surface]
    tyre = None
    if arguments.whole_plates:
        content = yaml.safe_load(Path(arguments.config).read_text(encoding="utf-8")) or {}
        tyre = read_config(content, arguments.config).tyre
    points, half_widths = augment(surface, candidates_in_box(surface, tyre), arguments.cases)
    print("further_cases:")
    for point, half_width in zip(points, half_widths, strict=True):
        values = ", ".join(
            f"{name}: {value:.10g}" for name, value in zip(surface.factors, point, strict=True)
        )
        print(f"  - {{{values}}} # 95 % interval ± {half_width:.3g}")
    return 0
