"""Fuzzing of the conditioning: tests with events, and an oracle that knows the truth.

    python benchmarks/ingest_fuzz_events.py [--inputs 3000] [--seed 1]

Each input is an invented test of a linear specimen whose modulus, strength and strain at every
instant are known: one file or machine and camera, with random rates, units, noise and clocks.
Up to three events happen to it: a break or none, cycles, an extensometer that is taken off, stands
still or slides back, a strain record that ends early, a load cell with the wrong sign, a part in
compression before the pull, slack, a unit that is wrong by a thousand, a channel that drops out for
some readings, the same data in another file. A test may be refused. A failure is an exception
other than InputError, or a curve whose strength, modulus or strain at the largest force differs
from the truth (a strain that is empty is allowed: it is not assessed).
"""

from __future__ import annotations

import argparse
import tempfile
import traceback
import warnings
from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from nptcs.arrays import Array
from nptcs.config.materials.ingest import IngestSettings
from nptcs.errors import InputError
from nptcs.ingest import Ingested, ingest_specimen, load_profiles
from nptcs.ingest.reading.profiles import FormatProfile
from nptcs.tables.laboratory.specimens import Specimen

ROOT = Path(__file__).resolve().parents[1]
EVENTS = (
    "cycles", "taken off", "stands still", "slides back", "ends early", "reversed cell",
    "compression first", "slack", "wrong unit", "machine stops", "away",
)  # fmt: skip
FORCE_UNITS = {"N": 1.0, "kN": 1e-3, "lbf": 1 / 4.4482216152605, "kgf": 1 / 9.80665}
STRAIN_UNITS = {"mm/mm": 1.0, "%": 100.0, "µm/m": 1e6}


@dataclass
class Truth:
    """A test about which everything is known, and what was done to its record."""

    modulus_mpa: float
    area_mm2: float
    time_s: Array
    strain: Array
    peak: int
    camera: bool
    events: set[str] = field(default_factory=set)
    last_strain: float = np.nan
    lost: bool = False

    @property
    def strength_mpa(self) -> float:
        """Largest stress."""
        return self.modulus_mpa * float(self.strain[: self.peak + 1].max())


def draw(random: np.random.Generator) -> Truth:
    """Draw a specimen, its loading and its events."""
    events = set(random.choice(EVENTS, size=int(random.integers(0, 4)), replace=False))
    if "slack" in events:
        events.discard("compression first")
    camera = bool(random.random() < 0.4) and "slack" not in events
    duration, rate = random.uniform(40, 100), random.uniform(5, 40)
    time = np.arange(0, duration, 1 / rate)
    ultimate = random.uniform(0.008, 0.03)
    strain = ultimate * time / time[-1]
    if "cycles" in events:
        cycles = []
        for share in random.uniform(0.3, 0.6, int(random.integers(1, 4))):
            up = np.linspace(0, share * ultimate, int(len(time) * share))
            cycles += [up, up[::-1]]
        strain = np.concatenate([*cycles, strain])
    if "compression first" in events:
        low = -random.uniform(0.3, 0.8) * ultimate
        strain = np.concatenate([np.linspace(low, 0, len(time) // 2), strain])
    peak = len(strain) - 1
    if "machine stops" not in events:
        strain = np.concatenate([strain, np.full(int(3 * rate), strain[-1])])
    time = np.arange(len(strain)) / rate
    truth = Truth(10 ** random.uniform(3.6, 5.2), random.uniform(5, 50), time, strain, peak, camera)
    truth.events = events
    return truth


def record(truth: Truth, random: np.random.Generator) -> tuple[Array, Array]:
    """Force and measured strain at the machine's instants, with noise and events."""
    broken = np.arange(len(truth.strain)) > truth.peak
    force = truth.modulus_mpa * truth.area_mm2 * np.where(broken, 0.01 * truth.strain, truth.strain)
    force = force + 2e-4 * np.abs(force).max() * random.standard_normal(len(force))
    strain = truth.strain + 2e-6 * random.standard_normal(len(force))
    strain[broken] = random.uniform(-0.02, 0.5) * truth.strain[truth.peak]
    pull = truth.peak - np.flatnonzero(np.diff(truth.strain[: truth.peak + 1])[::-1] < 0)
    begin = int(pull[0]) if len(pull) else 0
    at = begin + int(random.uniform(0.5, 0.9) * (truth.peak - begin))
    if "compression first" in truth.events:
        at = max(at, int(0.75 * truth.peak))
    lost = [name for name in ("taken off", "stands still", "slides back") if name in truth.events]
    if lost:
        truth.lost = True
        after = np.arange(len(strain)) >= at
        rest = {
            "taken off": np.full(len(strain), random.choice([-0.03, 0.0, 0.3 * strain[at]])),
            "stands still": np.full(len(strain), strain[at]),
            "slides back": strain[at] - 0.6 * (truth.strain - truth.strain[at]),
        }[lost[0]]
        strain = np.where(after, rest, strain)
    if "away" in truth.events:
        _away(truth, random, force, strain)
    return force, strain


def _away(truth: Truth, random: np.random.Generator, force: Array, strain: Array) -> None:
    """Let one channel read something else for two to six readings of the last loading."""
    begin = int(random.uniform(0.3, 0.95) * truth.peak)
    rows = slice(begin, begin + int(random.integers(2, 7)))
    channel = force if random.random() < 0.5 else strain
    channel[rows] = random.choice([0.0, -0.3, 3.0]) * np.abs(channel[: truth.peak]).max()


def write(
    truth: Truth, folder: Path, random: np.random.Generator, unit: str, strain_unit: str
) -> dict[str, str]:
    """Write the files and return the cells of the sheet that name them."""
    force, strain = record(truth, random)
    if "reversed cell" in truth.events:
        force = -force
    stated = {"N": "kN", "kN": "N"}.get(unit, "MN") if "wrong unit" in truth.events else unit
    written = force * FORCE_UNITS[unit]
    scaled = strain * STRAIN_UNITS[strain_unit]
    if "slack" in truth.events and not truth.camera:
        free = random.uniform(0.5, 2.0)
        slack = np.arange(0, free, free / 60)
        travel = np.concatenate([slack, free + 50 * (truth.strain - truth.strain[0])])
        load = np.concatenate([np.zeros(len(slack)), written])
        columns = {
            "Time [s]": np.arange(len(load)) / 10,
            f"Load [{stated}]": load,
            "Displacement [mm]": travel,
        }
        truth.lost = False
        _csv(folder / "m.csv", columns)
        return {"force_file": "m.csv"}
    if not truth.camera:
        columns = {
            "Time [s]": truth.time_s,
            f"Load [{stated}]": written,
            f"Strain [{strain_unit}]": scaled,
        }
        _csv(folder / "m.csv", columns)
        return {"force_file": "m.csv"}
    _csv(folder / "m.csv", {"Time [s]": truth.time_s, f"Load [{stated}]": written})
    clock, step = random.uniform(-20, 20), 1 / random.uniform(1.5, 10)
    frames = np.arange(0, truth.time_s[-1], step)
    if "ends early" in truth.events:
        truth.lost = True
        frames = frames[frames < random.uniform(0.75, 0.9) * truth.time_s[truth.peak]]
    rows = np.minimum(np.searchsorted(truth.time_s, frames), len(strain) - 1)
    both = np.interp(frames, truth.time_s, strain)
    across = rows > truth.peak
    both[across] = strain[rows[across]]
    seen = np.interp(frames, truth.time_s, written)
    seen[across] = written[rows[across]]
    columns = {
        "Time [s]": frames + clock,
        "exx [1]": both,
        "eyy [1]": -0.3 * both,
        f"Force [{stated}]": seen,
    }
    _csv(folder / "c.csv", columns)
    return {"force_file": "m.csv", "strain_file": "c.csv"}


def _csv(path: Path, columns: Mapping[str, Array]) -> None:
    lines = [";".join(columns)]
    lines += [";".join(f"{v:.8g}" for v in row) for row in zip(*columns.values(), strict=True)]
    path.write_text("\n".join(lines))


def judge(truth: Truth, done: Ingested) -> str:
    """Say where a curve differs from the truth; empty where it agrees."""
    if "wrong unit" in truth.events:
        return "a unit that is wrong by a thousand was not noticed"
    curve = done.curve
    stress, strain = curve["stress_mpa"].to_numpy(), curve["strain_axial"].to_numpy()
    if abs(stress.max() / truth.strength_mpa - 1) > 0.01:
        return f"strength {stress.max():.5g}, true value {truth.strength_mpa:.5g} MPa"
    peak = int(np.argmax(stress))
    ultimate = float(truth.strain[truth.peak])
    at_peak = strain[peak]
    if not np.isnan(at_peak) and abs(at_peak / ultimate - 1) > 0.04:
        return f"strain at strength {at_peak:.5g}, true value {ultimate:.5g}"
    if np.nanmax(strain) > 1.04 * ultimate or np.nanmin(strain) < -0.002:
        return (
            f"strains {np.nanmin(strain):.4g} to {np.nanmax(strain):.4g}, true end {ultimate:.4g}"
        )
    used = (np.arange(len(strain)) <= peak) & (strain > 0.001) & (strain < 0.004)
    if used.sum() >= 4:
        found = float(np.polyfit(strain[used], stress[used], 1)[0])
        if abs(found / truth.modulus_mpa - 1) > 0.03:
            return f"modulus {found:.5g}, true value {truth.modulus_mpa:.5g} MPa"
    return ""


def one_input(
    random: np.random.Generator, folder: Path, profiles: Mapping[str, FormatProfile]
) -> tuple[str, str, Truth]:
    """``right``, ``refused``, ``crash`` or ``wrong``, and why."""
    truth = draw(random)
    unit = str(random.choice(list(FORCE_UNITS)))
    strain_unit = str(random.choice(list(STRAIN_UNITS)))
    files = write(truth, folder, random, unit, strain_unit)
    specimen = Specimen(
        specimen="S",
        test="tension",
        material="m",
        orientation_deg=0,
        section_area_mm2=truth.area_mm2,
        gauge_length_mm=50.0,
        **files,
    )
    try:
        done = ingest_specimen(specimen, folder, IngestSettings(), profiles)
    except InputError as error:
        return "refused", error.message, truth
    except Exception:  # noqa: BLE001  (what the fuzz looks for)
        return "crash", traceback.format_exc(limit=-3), truth
    message = judge(truth, done) or _judge_repeat(done, specimen, folder, profiles)
    return ("wrong" if message else "right"), message, truth


def _judge_repeat(
    done: Ingested, specimen: Specimen, folder: Path, profiles: Mapping[str, FormatProfile]
) -> str:
    """Check that the same data with another delimiter are recognised, and changed data are not."""
    lines = (folder / specimen.force_file).read_text().split("\n")
    (folder / "twin.csv").write_text("\n".join(line.replace(";", "\t") for line in lines))
    cells = lines[len(lines) // 2].split(";")
    cells[1] = f"{float(cells[1]) * 1.001 + 1e-3:.8g}"
    lines[len(lines) // 2] = ";".join(cells)
    (folder / "other.csv").write_text("\n".join(lines))
    digests = []
    for name in ("twin.csv", "other.csv"):
        again = specimen.model_copy(update={"force_file": name})
        try:
            twin = ingest_specimen(again, folder, IngestSettings(), profiles)
        except InputError:
            return ""
        digests.append(twin.record.data_sha256)
    if digests[0] != done.record.data_sha256:
        return "the same data in another file were not recognised"
    return "other data were taken for the same" if digests[1] == digests[0] else ""


def main() -> int:
    """Run and report; 1 if anything failed."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--inputs", type=int, default=3000)
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    profiles = load_profiles(ROOT / "config" / "formats")
    outcome: Counter[str] = Counter()
    refusals: Counter[str] = Counter()
    failures: list[str] = []
    with tempfile.TemporaryDirectory() as name, warnings.catch_warnings():
        warnings.simplefilter("error")  # hides none: a warning of any library counts as a crash
        for number in range(arguments.inputs):
            random = np.random.default_rng([arguments.seed, number])
            result, message, truth = one_input(random, Path(name), profiles)
            outcome[result] += 1
            if result == "refused":
                known = sorted(truth.events & {"wrong unit", "reversed cell"})
                refusals[f"{message.split('(')[0][:40]} | {', '.join(known)}"] += 1
            if result in ("crash", "wrong"):
                what = ", ".join(sorted(truth.events)) + (" (camera)" if truth.camera else "")
                failures.append(f"input {number}: {what}: {message}")
    print(", ".join(f"{count} {name}" for name, count in sorted(outcome.items())))
    for message, count in refusals.most_common(12):
        print(f"  {count} refused: {message}")
    for failure in failures[:25]:
        print(failure)
    return 1 if failures else 0


if __name__ == "__main__":
    raise SystemExit(main())
