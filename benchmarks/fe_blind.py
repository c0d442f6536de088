"""The 63 + 15 published tyres computed with ``fe_tyre``, against tables 5 and 7.

    python benchmarks/fe_blind.py TABLE5.csv TABLE7.csv OUT.csv --workers 2

Prints the errors, time and peak memory of each worker. Table 5 does not state its rubbers: the
band's C10 is taken as 5, the spokes' as 1.04, where table 7 itself passes through table 5's
fiducial stiffness. How much that matters, on every seventh case:

    python benchmarks/fe_blind.py TABLE5.csv TABLE7.csv OUT.csv --every 7 --band-c10 4
"""

from __future__ import annotations

import argparse
import resource
import time
from concurrent.futures import ProcessPoolExecutor, as_completed
from pathlib import Path

import pandas as pd

from nptcs.config.tyre import TyreGeometry
from nptcs.fe.calibration import PUBLISHED_PLY
from nptcs.solvers.contract import CaseInputs
from nptcs.solvers.fe_tyre import SOLVER, FeTyreOptions

RUBBER_STUDY = {"spacing_mm": 15.0, "thickness_mm": 1.8, "angle_deg": 45.0}
FACTORS = ("spacing_mm", "thickness_mm", "angle_deg", "shear_band_c10_mpa", "spoke_c10_mpa")
# the five cases of table 5 that the section was calibrated on
CALIBRATED = {(15, 1.8, 45), (20, 1.2, 90), (10, 2.4, 0), (10, 1.2, 90), (20, 2.4, 0)}


def cases(table5: Path, table7: Path, band_c10: float, spoke_c10: float) -> pd.DataFrame:
    """Both published tables in one frame, with all factors."""
    plates = pd.read_csv(table5).assign(
        table=5, shear_band_c10_mpa=band_c10, spoke_c10_mpa=spoke_c10
    )
    rubbers = pd.read_csv(table7).assign(table=7, **RUBBER_STUDY)
    frame = pd.concat([plates, rubbers], ignore_index=True)
    frame["calibrated"] = [
        row.table == 5 and (row.spacing_mm, row.thickness_mm, row.angle_deg) in CALIBRATED
        for row in frame.itertuples()
    ]
    return frame


def compute(number: int, values: dict[str, float], cache: Path) -> dict[str, object]:
    """One case: stiffness, status, processor time and peak memory of the worker."""
    start = time.process_time()
    options = FeTyreOptions(spoke_cache=cache)
    result = SOLVER.solve(
        CaseInputs(f"case_{number:03d}", values, 5000.0, TyreGeometry(), options, ply=PUBLISHED_PLY)
    )
    return {
        "number": number,
        "status": result.status.value,
        "message": result.message,
        "computed_n_per_mm": result.vertical_stiffness_n_per_mm,
        "cpu_s": time.process_time() - start,
        "peak_mib": resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024.0,
        **result.extra,
    }


def summary(frame: pd.DataFrame) -> None:
    """Print the errors of each table, calibrated cases apart."""
    for label, part in (
        ("table 5, calibrated", frame[frame["calibrated"]]),
        ("table 5, blind", frame[(frame["table"] == 5) & ~frame["calibrated"]]),
        ("table 7, blind", frame[frame["table"] == 7]),
    ):
        error = part["error_percent"]
        if part.empty:
            continue
        print(
            f"{label}: {len(part)} cases, mean {error.mean():+.2f} %, "
            f"mean absolute {error.abs().mean():.2f} %, largest {error.abs().max():.2f} %, "
            f"{error.isna().sum()} failed"
        )


def main() -> None:
    """Compute all cases and write them with their errors."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("table5", type=Path)
    parser.add_argument("table7", type=Path)
    parser.add_argument("out", type=Path)
    parser.add_argument("--workers", type=int, default=2)
    parser.add_argument("--band-c10", type=float, default=5.0, help="band of table 5, MPa")
    parser.add_argument("--spoke-c10", type=float, default=1.04, help="spokes of table 5, MPa")
    parser.add_argument("--every", type=int, default=1, help="every n-th case of table 5 only")
    arguments = parser.parse_args()
    frame = cases(arguments.table5, arguments.table7, arguments.band_c10, arguments.spoke_c10)
    if arguments.every > 1:
        frame = frame[(frame["table"] == 5) & (frame.index % arguments.every == 0)]
    start = time.perf_counter()
    rows = []
    with ProcessPoolExecutor(arguments.workers) as pool:
        futures = [
            pool.submit(
                compute,
                number,
                {name: float(frame.loc[number, name]) for name in FACTORS},
                arguments.out.with_suffix(".spokes"),
            )
            for number in frame.index
        ]
        for future in as_completed(futures):
            rows.append(future.result())
            done = frame.join(pd.DataFrame(rows).set_index("number"), how="inner")
            done["error_percent"] = 100.0 * (
                done["computed_n_per_mm"] / done["stiffness_n_per_mm"] - 1.0
            )
            done.to_csv(arguments.out, index_label="number")
    wall = time.perf_counter() - start
    summary(done)
    print(
        f"{len(done)} cases on {arguments.workers} workers: {wall:.0f} s wall, "
        f"{done['cpu_s'].sum():.0f} s processor time, peak {done['peak_mib'].max():.0f} MiB"
    )


if __name__ == "__main__":
    main()
