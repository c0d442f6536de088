"""``nptcs augment``: propose further cases of a study where a surface is least certain."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any


def register(subparsers: Any) -> None:
    """Declare the arguments."""
    parser = subparsers.add_parser(
        "augment",
        help="propose further cases where a surface is least certain",
        description="Prints cases for the key `further_cases` of the study, each where the "
        "prediction interval is widest once the cases before it are added. The study must have "
        "been run.",
    )
    parser.add_argument("study", help="name of the study")
    parser.add_argument("--solver", required=True, help="solver whose surface is used")
    parser.add_argument("--surface", default="polynomial", help="its name; default: %(default)s")
    parser.add_argument("--cases", type=int, default=5, help="how many; default: %(default)s")
    parser.add_argument("--config", default="config/config.yaml", help="default: %(default)s")
    parser.add_argument(
        "--models",
        type=Path,
        default=Path("results/6_surface/models"),
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
    fitted = read_models(file).get(arguments.solver, {})
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
