"""How often the stated 95 % intervals hold the truth of the synthetic example data.

``python benchmarks/reduce_coverage.py [SEEDS] [CHORD_METHOD]`` makes the example data of as many
seeds, runs ingest, reduction and calibration on each, and prints for each constant the mean
deviation from the truth, the scatter over seeds beside the stated standard error, and the share
of 95 % intervals (Student's t) that hold the truth. 40 seeds take some three minutes.
"""

from __future__ import annotations

import sys
import tempfile
from pathlib import Path

import pandas as pd
from scipy import stats

from nptcs.calibrate import calibrate_ply, calibrate_rubber
from nptcs.config.calibration import CalibrationSettings
from nptcs.config.ingest import IngestSettings
from nptcs.config.reduction import AstmD3039, AstmD3518, ReductionSettings
from nptcs.example import truth
from nptcs.example.generate import generate
from nptcs.ingest import ingest_specimen, load_profiles
from nptcs.reduce import reduce_record
from nptcs.reduce.origin import origins_of
from nptcs.tables.material_card import Quantity
from nptcs.tables.specimens import read_sheet

ROOT = Path(__file__).resolve().parents[1]
PLY = {
    "e1_mpa": truth.E1_MPA,
    "e2_mpa": truth.E2_MPA,
    "nu12": truth.NU12,
    "g12_mpa": truth.G12_MPA,
}


def constants(folder: Path, settings: ReductionSettings) -> dict[str, tuple[Quantity, float]]:
    """Constants of one example folder, each with its true value."""
    specimens, _ = read_sheet(folder / "specimens.csv")
    profiles = load_profiles(ROOT / "config" / "formats")
    curves, tables, records = {}, [], []
    for specimen in specimens:
        done = ingest_specimen(specimen, folder, IngestSettings(), profiles)
        curves[specimen.specimen] = done.curve
        records.append(done.record)
        tables.append(reduce_record(done.curve, specimen, done.record, settings))
    calibration, origins = CalibrationSettings(), origins_of(records)
    ply = calibrate_ply(pd.concat(tables), specimens, calibration)
    found = {name: (ply.constants[name], value) for name, value in PLY.items()}
    for rubber, value in truth.C10_MPA.items():
        card = calibrate_rubber(rubber, curves, specimens, calibration, None, origins)
        found[f"c10_mpa {rubber}"] = (card.constants["c10_mpa"], value)
    return found


def main(seeds: int = 40, method: str = "nearest_points") -> None:
    """Print the table."""
    settings = ReductionSettings(
        astm_d3039=AstmD3039(chord_method=method), astm_d3518=AstmD3518(chord_method=method)
    )
    rows = []
    for seed in range(seeds):
        with tempfile.TemporaryDirectory() as folder:
            generate(Path(folder), seed)
            for name, (quantity, value) in constants(Path(folder), settings).items():
                half = stats.t.ppf(0.975, len(quantity.specimens) - 1) * quantity.standard_error
                rows.append(
                    {
                        "constant": name,
                        "deviation_percent": 100 * (quantity.value / value - 1),
                        "stated_percent": 100 * quantity.standard_error / value,
                        "inside": abs(quantity.value - value) <= half,
                    }
                )
        print(f"seed {seed + 1} of {seeds}", file=sys.stderr)
    table = pd.DataFrame(rows).groupby("constant", sort=False)
    summary = pd.DataFrame(
        {
            "mean_deviation_percent": table["deviation_percent"].mean(),
            "its_standard_error": table["deviation_percent"].std() / seeds**0.5,
            "scatter_percent": table["deviation_percent"].std(),
            "stated_error_percent": (table["stated_percent"].apply(lambda s: (s**2).mean() ** 0.5)),
            "share_inside": table["inside"].mean(),
        }
    )
    print(f"{seeds} seeds, {method}\n{summary.round(3).to_string()}")
    print(f"all together: {100 * pd.DataFrame(rows)['inside'].mean():.1f} % inside")


if __name__ == "__main__":
    main(*(kind(text) for kind, text in zip((int, str), sys.argv[1:], strict=False)))
