"""From a laboratory's folder to the material card, as a new user would go, with every step timed.

``python benchmarks/folder_to_card.py`` invents a campaign of 32 specimens of one laminate: machine
and camera files in parallel folders under different names, a table of dimensions per series, four
specimens without a camera, a summary, notes. Then it follows docs/lab-data.md: new-sheet, one
--fill per series, check, the run up to the card. It prints each command with its time, and the
card next to the constants that the campaign was made from. All numbers are invented.
"""

from __future__ import annotations

import json
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np
import yaml

from nptcs.arrays import Array
from nptcs.files import write_text

ROOT = Path(__file__).resolve().parents[1]
TRUE = {"e1_mpa": 128_000.0, "e2_mpa": 8_800.0, "nu12": 0.31, "g12_mpa": 4_500.0}
STRENGTH_MPA = {"UD0": 1_700.0, "UD90": 47.0, "PM45": 120.0, "CLC0": 900.0}
SERIES = {
    "UD0": "test=tension material=cfrp orientation_deg=0",
    "UD90": "test=tension material=cfrp orientation_deg=90",
    "PM45": "test=shear material=cfrp orientation_deg=45",
    "CLC0": "test=compression material=cfrp orientation_deg=0",
}
SCATTER = 0.02


def strains(series: str, stress: Array, factor: float) -> tuple[Array, Array]:
    """Axial and transverse strain under a stress in MPa; the ±45° laminate yields."""
    if series == "PM45":
        gamma = stress / 2 / (factor * TRUE["g12_mpa"])
        gamma = gamma * (1 + (stress / 110.0) ** 4)
        return 0.52 * gamma, -0.48 * gamma
    modulus = factor * TRUE["e2_mpa" if series == "UD90" else "e1_mpa"]
    poisson = TRUE["nu12"] * (TRUE["e2_mpa"] / TRUE["e1_mpa"] if series == "UD90" else 1.0)
    return stress / modulus, -poisson * stress / modulus


def shear_chord() -> float:
    """Slope of the invented ±45° curve over shear strains of 0.2 to 0.6 %, as D3518 asks."""
    stress = np.linspace(0, 100, 100_001)
    axial, transverse = strains("PM45", stress, 1.0)
    low, high = np.interp([0.002, 0.006], axial - transverse, stress / 2)
    return float(high - low) / 0.004


def write_campaign(folder: Path, random: np.random.Generator) -> int:
    """Write the files of 32 specimens; returns how many files there are."""
    for series, strength in STRENGTH_MPA.items():
        rows = ["Sample,W Top,W Mid,W Bottom,T Left,T Mid,T Right"]
        for number in range(1, 9):
            width, thickness = random.normal(15, 0.05, 3), random.normal(1.0, 0.01, 3)
            rows.append(f"{number}," + ",".join(f"{v:.3f}" for v in [*width, *thickness]))
            area = round(float(width.mean()), 3) * round(float(thickness.mean()), 3)
            write_specimen(folder, series, number, strength, area, random)
        write_text(folder / f"Dimensions{series}.csv", "\n".join(rows) + "\n")
    write_text(folder / "Summary.csv", "Specimen,Max load (N)\nUD0_1,25000\nUD0_2,25100\n")
    write_text(folder / "notes.txt", "Camera failed for number 5 of each series.\n")
    return sum(path.is_file() for path in folder.rglob("*"))


def write_specimen(
    folder: Path,
    series: str,
    number: int,
    strength: float,
    area: float,
    random: np.random.Generator,
) -> None:
    """Write machine and camera file of one specimen that breaks."""
    sign = -1.0 if series == "CLC0" else 1.0
    top = strength * random.normal(1, SCATTER)
    time_s = np.arange(0, 120, 0.1)
    stress = top * time_s / time_s[-1]
    axial, transverse = strains(series, stress, random.normal(1, SCATTER))
    force = sign * np.append(stress * area, [20.0, 10.0])
    force = force + 2e-4 * strength * area * random.standard_normal(len(force))
    travel = sign * np.append(0.02 * time_s, [2.4, 2.4])
    clock = np.append(time_s, time_s[-1] + [0.1, 0.2])
    machine = folder / "MTS" / f"MTS_{series}_{number}.csv"
    lines = ["Time (s),Crosshead (mm),Load (kN)"]
    lines += [
        f"{a:.2f},{b:.4f},{c / 1000:.6f}" for a, b, c in zip(clock, travel, force, strict=True)
    ]
    write_text(machine, "\n".join(lines) + "\n")
    if number == 5:
        return
    frames = np.arange(0, 119, 0.5)
    seen = [sign * np.interp(frames, time_s, one) for one in (axial, transverse)]
    seen = [one + 5e-6 * random.standard_normal(len(frames)) for one in seen]
    load = sign * np.interp(frames, time_s, stress * area)
    lines = ['"Count";"Time_0";"exx [1] - Lagrange";"eyy [1] - Lagrange";"Force"']
    lines += [
        f"{i};{a + 7.3:.3f};{c:.7f};{b:.7f};{d:.2f}"
        for i, (a, b, c, d) in enumerate(zip(frames, *seen, load, strict=True))
    ]
    write_text(folder / "DIC" / f"DIC_{series}_{number}.csv", "\n".join(lines) + "\n")


def timed(words: list[str], folder: Path) -> float:
    """Run a command, print its time (and its output if it fails), and return the time in s."""
    start = time.monotonic()
    done = subprocess.run(words, cwd=folder, capture_output=True, text=True, check=False)
    spent = time.monotonic() - start
    print(f"{spent:6.1f} s  {' '.join(words)}  (exit code {done.returncode})")
    if done.returncode:
        print(done.stdout[-2000:], done.stderr[-3000:])
    return spent


def main() -> int:
    """Run and report; 1 if a constant is further from the truth than three standard errors."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        files = write_campaign(folder / "lab", np.random.default_rng(7))
        for part in ("config", "workflow", "raw_data", "profiles"):
            (folder / part).symlink_to(ROOT / part)
        (folder / "Snakefile").symlink_to(ROOT / "Snakefile")
        config = yaml.safe_load((ROOT / "config" / "config.yaml").read_text(encoding="utf-8"))
        # the study of the tested rubbers needs specimens that this campaign does not have
        config["studies"] = [one for one in config["studies"] if one["name"] != "tested"]
        config["lab_data"] = {
            "specimen_sheet": "lab/specimens.csv",
            "formats": "config/formats",
        }
        write_text(folder / "mine.yaml", yaml.safe_dump(config))
        print(f"{files} files of 32 specimens in 4 series")
        fills = [f"{series}: {cells}" for series, cells in SERIES.items()]
        total = timed(["nptcs", "new-sheet", "lab"], folder)
        # no gauge length: without a camera a specimen gives its strength, and no wrong modulus
        words = [word for fill in fills for word in ("--fill", fill)]
        total += timed(["nptcs", "new-sheet", "lab", *words], folder)
        total += timed(["nptcs", "check", "mine.yaml"], folder)
        target = "results/3_calibrate/cfrp.json"
        tables = ["results/tables/statistics.csv", "results/tables/files.csv"]
        run = ["snakemake", "-j2", target, *tables, "--configfile", "mine.yaml"]
        total += timed(run, folder)
        print(f"{total:6.1f} s  from the folder to the card")
        card = json.loads((folder / target).read_text(encoding="utf-8"))["constants"]
        worst = 0.0
        for constant, true in (TRUE | {"g12_mpa": shear_chord()}).items():
            value, error = card[constant]["value"], card[constant]["standard_error"]
            worst = max(worst, abs(value - true) / error)
            print(f"{constant:8} {value:10.5g} ± {error:.2g}, truly {true:g}")
    return int(worst > 3)


if __name__ == "__main__":
    sys.exit(main())
