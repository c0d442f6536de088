"""What reduction and calibration cost, compared with reading the same curve from a CSV file.

``python benchmarks/reduce_speed.py [ROWS]`` takes one tension and one rubber curve of that many
rows (10,000 by default) and prints the median time of each step of 15 runs, side by side in one
process, and its ratio to ``pandas.read_csv`` of the same curve.
"""

from __future__ import annotations

import io
import statistics
import sys
import time
from collections.abc import Callable

import numpy as np
import pandas as pd

from nptcs.calibrate import calibrate_rubber, compare_models
from nptcs.config.materials.calibration import CalibrationSettings
from nptcs.config.materials.reduction import ReductionSettings
from nptcs.reduce import reduce_specimen
from nptcs.tables.laboratory.specimens import Specimen

RUNS = 15


def curve(strain: np.ndarray, stress: np.ndarray) -> pd.DataFrame:
    """Make a tidy curve with transverse strain."""
    return pd.DataFrame(
        {
            "time_s": np.linspace(0, 120, len(strain)),
            "force_n": 12 * stress,
            "stress_mpa": stress,
            "strain_axial": strain,
            "strain_transverse": -0.3 * strain,
            "strain_axial_back": np.nan,
        }
    )


def main(rows: int = 10_000) -> None:
    """Print the table."""
    rng = np.random.default_rng(1)
    strain = np.linspace(0, 0.015, rows)
    tension = curve(strain, 128000 * strain + rng.normal(0, 1, rows))
    stretch = np.linspace(1, 2, rows)
    names = ("R-1", "R-2", "R-3")
    rubber = {
        n: curve(stretch - 1, 2.36 * (stretch - stretch**-2) + rng.normal(0, 0.01, rows))
        for n in names
    }
    fields = {"width_mm": (6.0,), "thickness_mm": (2.0,), "force_file": "x.csv"}
    bar = Specimen(specimen="T-1", test="tension", material="cfrp", orientation_deg=0.0, **fields)
    sheet = [
        Specimen(specimen=n, test="rubber_tension", material="rubber_75A", **fields) for n in names
    ]
    text = tension.to_csv(index=False)
    calibration = CalibrationSettings()
    steps: dict[str, Callable[[], object]] = {
        "pandas.read_csv of the curve": lambda: pd.read_csv(io.StringIO(text)),
        "reduce_specimen, tension": lambda: reduce_specimen(tension, bar, ReductionSettings()),
        "reduce_specimen, rubber": lambda: reduce_specimen(
            rubber["R-1"], sheet[0], ReductionSettings()
        ),
        "calibrate_rubber, 3 curves": lambda: calibrate_rubber(
            "rubber_75A", rubber, sheet, calibration
        ),
        "compare_models, 3 curves": lambda: compare_models(
            "rubber_75A", rubber, sheet, calibration
        ),
    }
    times: dict[str, list[float]] = {name: [] for name in steps}
    for _ in range(RUNS):
        for name, step in steps.items():
            start = time.perf_counter()
            step()
            times[name].append(time.perf_counter() - start)
    medians = {name: statistics.median(values) for name, values in times.items()}
    base = medians["pandas.read_csv of the curve"]
    for name, seconds in medians.items():
        print(f"{name:32} {1000 * seconds:8.1f} ms   {seconds / base:6.2f} x read_csv")


if __name__ == "__main__":
    main(*(int(text) for text in sys.argv[1:]))
