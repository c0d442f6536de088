"""A thousand readings of files of ten thousand rows: time, memory, and what dominates.

    python benchmarks/ingest_many_files.py [--files 1000] [--rows 10000]

All figures come from one process in one run. As a measure of the machine, the same files are read
by ``pandas.read_csv`` alone, given in advance what detection finds out; the ratio is the cost of
detection, checks, conditioning and the record.
"""

from __future__ import annotations

import argparse
import cProfile
import pstats
import resource
import tempfile
import time
from collections.abc import Mapping
from pathlib import Path

import numpy as np
import pandas as pd

from nptcs.config.materials.ingest import IngestSettings
from nptcs.ingest import ingest_specimen, load_profiles
from nptcs.ingest.reading.profiles import FormatProfile
from nptcs.tables.laboratory.specimens import Specimen

ROOT = Path(__file__).resolve().parents[1]
DIFFERENT = 20
PARTS = (
    ("decoding", "open_file"),
    ("finding the dialect", "find_dialect"),
    ("finding the tables", "find_tables"),
    ("reading the numbers", "numbers"),
    ("conditioning", "empty_spikes empty_after_removal correct_origin cut_end drop_empty_rows"),
    ("checking the curve's contract", "_curve"),
)


def write_files(folder: Path, rows: int) -> None:
    """Write the few different testXpert files that are read in turn."""
    for number in range(DIFFERENT):
        random = np.random.default_rng(number)
        strain = np.linspace(0, 1.2, rows)
        force = 1400 * strain + random.normal(0, 0.5, rows)
        table = pd.DataFrame(
            {
                "Prüfzeit": np.arange(rows) * 0.02,
                "Standardweg": strain * 1.4,
                "Standardkraft": force,
                "Dehnung": strain + random.normal(0, 1e-4, rows),
                "Querdehnung": -0.3 * strain,
            }
        )
        head = "\t".join(table.columns) + "\r\ns\tmm\tN\t%\t%\r\n"
        body = table.to_csv(sep="\t", decimal=",", index=False, header=False, float_format="%.6g")
        (folder / f"{number}.tra").write_bytes((head + body).encode("latin-1"))


def ingest_one(folder: Path, number: int, profiles: Mapping[str, FormatProfile]) -> None:
    """Ingest a file as its own specimen."""
    specimen = Specimen(
        specimen=f"S-{number}",
        test="tension",
        material="cfrp",
        orientation_deg=0,
        width_mm=(10.0,),
        thickness_mm=(0.1,),
        force_file=f"{number % DIFFERENT}.tra",
    )
    ingest_specimen(specimen, folder, IngestSettings(), profiles)


def read_plainly(folder: Path, number: int) -> None:
    """Read the same file with the format given in advance."""
    path = folder / f"{number % DIFFERENT}.tra"
    pd.read_csv(path, sep="\t", decimal=",", skiprows=[1], encoding="latin-1")


def side_by_side(
    folder: Path, files: int, profiles: Mapping[str, FormatProfile]
) -> tuple[float, float]:
    """CPU seconds of ingest and of pandas, file by file in turn: other load affects both alike."""
    ingest = plain = 0.0
    for number in range(files):
        start = time.process_time()
        ingest_one(folder, number, profiles)
        middle = time.process_time()
        read_plainly(folder, number)
        ingest, plain = ingest + middle - start, plain + time.process_time() - middle
    return ingest, plain


def shares(folder: Path, profiles: Mapping[str, FormatProfile]) -> list[tuple[str, float]]:
    """Share of each part in the time, by the profiler over `DIFFERENT` files."""
    profiler = cProfile.Profile()
    for number in range(DIFFERENT):
        profiler.runcall(ingest_one, folder, number, profiles)
    stats = pstats.Stats(profiler).stats  # type: ignore[attr-defined]
    total = max(entry[3] for entry in stats.values())
    found = []
    for name, functions in PARTS:
        spent = sum(
            entry[3]
            for (file, _, function), entry in stats.items()
            if function in functions.split() and "nptcs" in file
        )
        found.append((name, spent / total))
    return sorted(found, key=lambda part: -part[1])


def main() -> int:
    """Run and report."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--files", type=int, default=1000)
    parser.add_argument("--rows", type=int, default=10_000)
    arguments = parser.parse_args()
    profiles = load_profiles(ROOT / "config" / "formats")
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        write_files(folder, arguments.rows)
        size = (folder / "0.tra").stat().st_size
        side_by_side(folder, 3, profiles)
        ingest, plain = side_by_side(folder, arguments.files, profiles)
        peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
        print(f"{arguments.files} files of {arguments.rows} rows ({size / 1e6:.2f} MB each)")
        print(f"ingest {ingest:.1f} s of CPU, {1000 * ingest / arguments.files:.0f} ms per file")
        print(f"pandas.read_csv alone {plain:.1f} s of CPU; ratio {ingest / plain:.1f}")
        print(f"peak memory {peak:.0f} MB")
        for part, share in shares(folder, profiles):
            print(f"  {100 * share:3.0f} % {part}")
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
