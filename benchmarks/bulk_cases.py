"""Many cheap cases end to end: time and memory of a whole run, and of a run with one more level.

    python benchmarks/bulk_cases.py [--levels 317] [--jobs 2]

A study of the load-bearing model with LEVELS by LEVELS - 1 rubbers is run by Snakemake from the
raw data to report and workbook; then a level is added, and only its cases are solved. Processor
time and memory are those of all processes together.
"""

from __future__ import annotations

import argparse
import shutil
import tempfile
from pathlib import Path

import numpy as np
import yaml
from commands import ROOT, run

FACTORS = ("shear_band_c10_mpa", "spoke_c10_mpa")
BAND, SPOKE = FACTORS


def write_study(config: Path, counts: tuple[int, int]) -> None:
    """Replace the studies of a configuration by one fine grid of two rubbers."""
    values = yaml.safe_load(config.read_text(encoding="utf-8"))
    levels = [[round(float(level), 6) for level in np.linspace(1, 5, n)] for n in counts]
    values["studies"] = [
        {
            "name": "grid",
            "title": "A fine grid of two rubbers",
            "factors": [
                {"name": name, "label": name, "unit": "MPa", "levels": of_factor}
                for name, of_factor in zip(FACTORS, levels, strict=True)
            ],
            "solvers": ["lca"],
            "terms": ["1", BAND, SPOKE, f"{BAND}^2", f"{SPOKE}^2", f"{BAND}*{SPOKE}"],
        }
    ]
    values["uncertainty"] = {**(values.get("uncertainty") or {}), "surface": "polynomial"}
    values["campaign"] = {**(values.get("campaign") or {}), "most_cases": 10**6}
    config.write_text(yaml.safe_dump(values, sort_keys=False), encoding="utf-8")


def main() -> None:
    """Print one row per run."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--levels", type=int, default=317)
    parser.add_argument("--jobs", type=int, default=2)
    arguments = parser.parse_args()
    levels = arguments.levels
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name) / "project"
        for part in ("config", "raw_data", "profiles", "workflow"):
            ignored = shutil.ignore_patterns("__pycache__")
            shutil.copytree(ROOT / part, folder / part, ignore=ignored)
        print(f"{'run':26}{'cases':>9}{'wall s':>9}{'CPU s':>9}{'MB':>9}{'report MB':>11}")
        for what, counts in (
            ("first", (levels, levels - 1)),
            ("one more level", (levels + 1, levels - 1)),
            ("nothing to do", (levels + 1, levels - 1)),
        ):
            write_study(folder / "config/config.yaml", counts)
            log = Path(name) / "log"
            used = run(["snakemake", f"-j{arguments.jobs}"], folder, log)
            if used.code:
                print(log.read_text(encoding="utf-8")[-3000:])
            page = folder / "results/report.html"
            size = page.stat().st_size / 1e6 if page.is_file() else float("nan")
            cases = counts[0] * counts[1]
            print(
                f"{what:26}{cases:9}{used.wall_s:9.1f}{used.cpu_s:9.1f}{used.memory_mb:9.0f}"
                f"{size:11.2f}",
                flush=True,
            )


if __name__ == "__main__":
    main()
