"""Random tests of a known material, from raw file to properties, against an oracle.

``python benchmarks/reduce_fuzz.py [COUNT] [SEED]`` writes COUNT exports of a laminate of known
modulus and strength: loaded once or in cycles; stopped, held, unloaded slowly or by a quick
return, or broken at once or over some readings; the gauge on to the end or taken off; the record
with slack and noise, at many rates; channels scaled. Each is ingested and reduced. A value that is
given must be true within its tolerance; strength and ultimate strain must be given where the
specimen broke with its gauge on, and must not be given where it did not break. Prints every value
that is wrong, how many values were given, and why a modulus was not. 1,000 exports take a minute
of one core.
"""

from __future__ import annotations

import sys
import tempfile
from collections import Counter
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pandas as pd

from nptcs.config.materials.ingest import IngestSettings
from nptcs.config.materials.reduction import ReductionSettings
from nptcs.errors import InputError
from nptcs.ingest import ingest_specimen, load_profiles
from nptcs.reduce import reduce_record
from nptcs.tables.laboratory.specimens import Specimen

ROOT = Path(__file__).resolve().parents[1]
AREA = 15.0
ENDS = ("broken", "broken slowly", "stopped", "held", "unloaded", "returned")


@dataclass(frozen=True)
class Truth:
    """What the export was made from; `loadings` counts those of the record."""

    modulus: float
    top: float
    end: str
    loadings: int
    gauge_off: bool
    force_factor: float

    @property
    def broke(self) -> bool:
        """Whether the specimen failed."""
        return self.end.startswith("broken")


def draw(random: np.random.Generator) -> tuple[Truth, pd.DataFrame]:
    """Draw a truth and the readings of a machine that tests it."""
    modulus = float(np.exp(random.uniform(np.log(5e3), np.log(2e5))))
    end = str(random.choice(ENDS))
    top = float(
        random.uniform(0.007, 0.02) if end.startswith("broken") else random.uniform(0.0033, 0.006)
    )
    cycles = int(random.choice([0, 0, 0, 1, 2, 4]))
    course = [0.0, *([0.6 * top, 0.02 * top] * cycles), top]
    step = top / random.integers(120, 1500)
    strain = np.concatenate(
        [
            np.linspace(a, b, max(int(abs(b - a) / step), 5))[1:]
            for a, b in zip(course, course[1:], strict=False)
        ]
    )
    force = modulus * strain * AREA
    more_strain, more_force = after(end, top, modulus * top * AREA, step, random)
    strain, force = np.append(strain, more_strain), np.append(force, more_force)
    peak = int(np.argmax(force))
    gauge_off = cycles == 0 and bool(random.random() < 0.2)
    seen = strain.copy()
    if gauge_off:
        off = int(random.uniform(0.55, 0.8) * peak)
        seen[off:] = seen[off - 1] if random.random() < 0.5 else random.uniform(-0.03, 0.0)
    if random.random() < 0.3:
        slack = int(random.uniform(0.0005, 0.003) / step) + 1
        seen = np.concatenate([np.linspace(0, slack * step, slack), slack * step + seen])
        force = np.concatenate([np.zeros(slack), force])
    noise = random.choice([0.0, 1e-4, 5e-4])
    force = force + noise * force.max() * random.standard_normal(len(force))
    seen = seen + 0.2 * noise * top * random.standard_normal(len(seen))
    factor = float(random.choice([1.0, 1.0, 0.5, -1.0]))
    table = {
        "Time (s)": 0.2 * np.arange(len(force)),
        "Load (N)": force / factor,
        "Axial strain (%)": 100 * seen,
    }
    return Truth(modulus, top, end, cycles + 1, gauge_off, factor), pd.DataFrame(table)


def after(
    end: str, top: float, largest: float, step: float, random: np.random.Generator
) -> tuple[np.ndarray, np.ndarray]:
    """Return strain and force of the readings after the largest force."""
    rows = int(random.integers(60, 300))
    match end:
        case "broken":
            count = int(random.integers(1, 5))
            return np.full(count, top * random.uniform(0, 1)), np.full(count, 0.01 * largest)
        case "broken slowly":
            strain = top + step * np.arange(1, rows)
            return strain, largest * np.linspace(1, 0.3, rows)[1:]
        case "held":
            return np.full(rows, top), largest * (1 - 0.12 * np.linspace(0, 1, rows))
        case "unloaded":
            strain = np.linspace(top, 0, rows)[1:]
        case "returned":
            strain = np.linspace(top, 0, int(random.integers(6, 20)))[1:]
        case _:
            return np.empty(0), np.empty(0)
    return strain, largest * strain / top


def faults(truth: Truth, table: pd.DataFrame) -> list[str]:
    """Values that are wrong, that should not be there, or that should be."""
    value = table.set_index("property")["value"]
    strength = truth.modulus * truth.top
    found = []
    for name, true, tolerance in (
        ("modulus", truth.modulus, 0.03),
        ("strength", strength, 0.01),
        ("ultimate_strain", truth.top, 0.03),
    ):
        given, needs = np.isfinite(value[name]), name != "modulus"
        if given and abs(value[name] / true - 1) > tolerance:
            found.append(f"{name} {value[name]:.5g}, truth {true:.5g}")
        # a gauge that was taken off counts as a test to failure; the value says so
        if given and needs and not truth.broke and not truth.gauge_off:
            found.append(f"{name} {value[name]:.5g} of a specimen that did not fail")
        if not given and needs and truth.broke and not truth.gauge_off:
            found.append(f"{name} not given")
    told = table["flags"].str.extract(r"(\d+) loadings in the record")[0].dropna()
    count = int(told.iloc[0]) if len(told) else 1
    if count != truth.loadings:
        found.append(f"{count} loadings, truth {truth.loadings}")
    return found


def main(count: int = 1000, seed: int = 1) -> None:
    """Print what is wrong, and the counts."""
    profiles, random = load_profiles(ROOT / "config" / "formats"), np.random.default_rng(seed)
    counts: Counter[str] = Counter()
    with tempfile.TemporaryDirectory() as folder:
        for number in range(count):
            truth, readings = draw(random)
            readings.to_csv(Path(folder, "raw.csv"), index=False, float_format="%.8g")
            specimen = Specimen(
                specimen=f"X-{number}",
                test="tension",
                material="m",
                orientation_deg=0,
                section_area_mm2=AREA,
                force_file="raw.csv",
                force_factor=truth.force_factor,
            )
            try:
                done = ingest_specimen(specimen, folder, IngestSettings(), profiles)
                table = reduce_record(done.curve, specimen, done.record, ReductionSettings())
            except InputError as error:
                counts["refused"] += 1
                print(f"{number} refused {truth}: {error.message}")
                continue
            counts.update(f"{name} given" for name in table.dropna(subset="value")["property"])
            lost = table[(table["property"] == "modulus") & table["value"].isna()]
            counts.update(f"no modulus: {flags.split('; ')[0][:60]}" for flags in lost["flags"])
            for fault in faults(truth, table):
                counts["wrong"] += 1
                print(f"{number} {fault} {truth}")
    for name, number in counts.most_common():
        print(f"{number:6d} {name}")
    print(f"{count} exports, seed {seed}: {counts['wrong']} wrong")


if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))
