"""How often the stated 95 % intervals contain the truth of the synthetic example data.

``python benchmarks/reduce_coverage.py [SEEDS] [CHORD_METHOD]`` makes the example data of as many
seeds, runs ingest, reduction and calibration on each, and prints for each constant the mean
deviation from the truth, the scatter over seeds next to the stated standard error, and the share
of 95 % intervals (Student's t) that contain the truth. 40 seeds take about three minutes.

``python benchmarks/reduce_coverage.py origin [DRAWS]`` simulates single curves of a neo-Hookean
rubber and of a laminate, of four kinds: through (0, 0), digitised with noise, with a toe, and
recorded from a preload. It prints how often value ± 1.96 standard errors contains the truth, with
the correction of the strain origin as it is, and how often that correction was applied.
"""

from __future__ import annotations

import sys
import tempfile
from pathlib import Path

import numpy as np
import pandas as pd
from scipy import stats

from nptcs.calibrate import calibrate_ply, calibrate_rubber
from nptcs.config.materials.calibration import CalibrationSettings
from nptcs.config.materials.ingest import IngestSettings
from nptcs.config.materials.reduction import AstmD3039, AstmD3518, ReductionSettings
from nptcs.example import truth
from nptcs.example.generate import generate
from nptcs.ingest import ingest_specimen, load_profiles
from nptcs.ingest.conditioning.signals import Signals
from nptcs.ingest.conditioning.strain_origin import correct_origin
from nptcs.mechanical_tests import TestType
from nptcs.reduce import reduce_record
from nptcs.reduce.strain_origin import strain_origin_of, strain_origins_of
from nptcs.tables.laboratory.curves import CURVE_COLUMNS, IngestRecord
from nptcs.tables.laboratory.material_card import CardConstant
from nptcs.tables.laboratory.specimens import Specimen, read_sheet

ROOT = Path(__file__).resolve().parents[1]
PLY = {
    "e1_mpa": truth.E1_MPA,
    "e2_mpa": truth.E2_MPA,
    "nu12": truth.NU12,
    "g12_mpa": truth.G12_MPA,
}


def constants(folder: Path, settings: ReductionSettings) -> dict[str, tuple[CardConstant, float]]:
    """Constants of one example folder, each with its true value."""
    specimens, _ = read_sheet(folder / "specimens.csv")
    profiles = load_profiles(ROOT / "config" / "formats")
    curves, tables, records = {}, [], []
    for specimen in specimens:
        done = ingest_specimen(specimen, folder, IngestSettings(), profiles)
        curves[specimen.specimen] = done.curve
        records.append(done.record)
        tables.append(reduce_record(done.curve, specimen, done.record, settings))
    calibration, origins = CalibrationSettings(), strain_origins_of(records)
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


C10_MPA, E_MPA = 1.0, 120_000.0
KINDS = ("through the origin", "digitised", "toe", "preload")


def one_curve(kind: str, rubber: bool, random: np.random.Generator) -> pd.DataFrame:
    """One simulated curve: stress in MPa against strain, as a machine or a digitiser gives it."""
    top = 0.6 if rubber else 0.014
    count = 120 if kind == "digitised" else 500
    strain = np.linspace(0, top, count)
    stress = 2 * C10_MPA * ((1 + strain) - (1 + strain) ** -2.0) if rubber else E_MPA * strain
    share = 0.004 if kind == "digitised" else 0.0005
    if kind == "toe":
        load = stress / stress[-1]
        toe = random.uniform(0.002, 0.005) if rubber else random.uniform(0.0001, 0.0004)
        strain = strain + toe * (1 - np.exp(-load / 0.004))
    if kind == "preload":
        first = int(np.argmax(stress >= 0.01 * stress[-1]))
        stress, strain = stress[first:], strain[first:] - strain[first]
    return pd.DataFrame(
        {
            "stress": stress + share * stress[-1] * random.standard_normal(len(stress)),
            "strain": strain + share * strain[-1] * random.standard_normal(len(strain)),
        }
    )


def conditioned(curve: pd.DataFrame, rubber: bool) -> tuple[pd.DataFrame, IngestRecord]:
    """Return the curve after the correction of its origin, and the record of that."""
    nothing = np.full(len(curve), np.nan)
    values = {name: nothing.copy() for name in CURVE_COLUMNS}
    values |= {"stress": curve["stress"].to_numpy(), "strain_axial": curve["strain"].to_numpy()}
    signals = Signals(values)
    correct_origin(signals, IngestSettings().strain_origin, rubber)
    table = pd.DataFrame({name: signals.values[name] for name in CURVE_COLUMNS})
    table["stress_mpa"] = table["force_n"] = signals.values["stress"]
    return table, IngestRecord(specimen="X", status="ok", steps=tuple(signals.steps))


def of_one_curve(kind: str, rubber: bool, random: np.random.Generator) -> dict[str, object]:
    """Deviation from the truth over its standard error, and whether the origin was shifted."""
    curve, record = conditioned(one_curve(kind, rubber, random), rubber)
    fields = {"specimen": "X", "material": "m", "section_area_mm2": 1.0, "force_file": "x.csv"}
    if rubber:
        specimen = Specimen(test=TestType.RUBBER_TENSION, **fields)
        card = calibrate_rubber(
            "m", {"X": curve}, [specimen], CalibrationSettings(), None, strain_origins_of([record])
        )
        value, error = card.constants["c10_mpa"].value, card.constants["c10_mpa"].standard_error
        truth_value = C10_MPA
    else:
        specimen = Specimen(test=TestType.TENSION, orientation_deg=0, **fields)
        settings = ReductionSettings(astm_d3039=AstmD3039(chord_method="least_squares"))
        row = reduce_record(curve, specimen, record, settings).set_index("property").loc["modulus"]
        value, error, truth_value = row["value"], row["standard_error"], E_MPA
    origin = strain_origin_of(record)
    return {
        "kind": f"{kind}, {'C10' if rubber else 'modulus'}",
        "deviation_percent": 100 * (value / truth_value - 1),
        "stated_percent": 100 * error / truth_value,
        "inside": abs(value - truth_value) <= 1.96 * error,
        "shifted": bool(origin is not None and origin.added),
    }


def origins(draws: int = 200) -> None:
    """Print the coverage of single curves."""
    random = np.random.default_rng(13)
    rows = [
        of_one_curve(kind, rubber, random)
        for rubber in (True, False)
        for kind in KINDS
        for _ in range(draws)
    ]
    table = pd.DataFrame(rows).groupby("kind", sort=False)
    summary = pd.DataFrame(
        {
            "mean_deviation_percent": table["deviation_percent"].mean(),
            "scatter_percent": table["deviation_percent"].std(),
            "stated_error_percent": table["stated_percent"].mean(),
            "share_inside": table["inside"].mean(),
            "share_shifted": table["shifted"].mean(),
        }
    )
    print(f"{draws} curves of each kind\n{summary.round(3).to_string()}")


if __name__ == "__main__":
    if sys.argv[1:2] == ["origin"]:
        origins(*map(int, sys.argv[2:3]))
        sys.exit()
    main(*(kind(text) for kind, text in zip((int, str), sys.argv[1:], strict=False)))
