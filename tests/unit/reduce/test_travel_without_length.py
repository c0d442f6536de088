"""A test with only force and crosshead travel gives its strength and nothing else."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from nptcs.config.materials.ingest import IngestSettings
from nptcs.config.materials.reduction import ReductionSettings
from nptcs.ingest import ingest_specimen, load_profiles
from nptcs.reduce import reduce_record
from nptcs.tables.laboratory.specimens import Specimen

ROOT = Path(__file__).resolve().parents[3]
LARGEST_N, AREA_MM2 = 9000.0, 15.0
RISE = np.linspace(0, 1, 300)


def reduced(folder: Path, force: np.ndarray, travel: np.ndarray, **fields: object) -> pd.DataFrame:
    readings = {"Time (s)": 0.1 * np.arange(len(force)), "Crosshead (mm)": travel}
    pd.DataFrame(readings | {"Load (N)": force}).to_csv(folder / "raw.csv", index=False)
    standard = {
        "specimen": "S",
        "test": "tension",
        "material": "m",
        "orientation_deg": 0,
        "section_area_mm2": AREA_MM2,
        "force_file": "raw.csv",
    }
    specimen = Specimen(**(standard | fields))
    profiles = load_profiles(ROOT / "config" / "formats")
    done = ingest_specimen(specimen, folder, IngestSettings(), profiles)
    assert any("gauge_length_mm is empty" in flag for flag in done.record.flags)
    table = reduce_record(done.curve, specimen, done.record, ReductionSettings())
    return table.set_index("property")


@pytest.mark.parametrize(("test", "sign"), [("tension", 1), ("compression", -1)])
def test_strength_of_a_specimen_that_broke(tmp_path, test, sign):
    force = sign * np.append(LARGEST_N * RISE, [30.0, 20.0, 10.0])
    travel = sign * np.append(2 * RISE, [2.01, 2.02, 2.03])
    table = reduced(tmp_path, force, travel, test=test)
    assert table.loc["strength", "value"] == pytest.approx(LARGEST_N / AREA_MM2, rel=0.005)
    for name in ("modulus", "ultimate_strain", "poisson_ratio", "strain_rate"):
        assert np.isnan(table.loc[name, "value"])
        assert "not assessed" in table.loc[name, "flags"]


@pytest.mark.parametrize("rows", [8, 40, 300])
def test_no_strength_of_a_specimen_that_was_unloaded(tmp_path, rows):
    back = np.linspace(1, 0, rows)[1:]
    table = reduced(tmp_path, LARGEST_N * np.append(RISE, back), 2 * np.append(RISE, back))
    assert np.isnan(table.loc["strength", "value"])
    assert "no failure seen" in table.loc["strength", "flags"]


def test_no_strength_where_the_record_ends_at_its_largest_force(tmp_path):
    table = reduced(tmp_path, LARGEST_N * RISE, 2 * RISE)
    assert np.isnan(table.loc["strength", "value"])


def test_what_the_sheet_states_counts(tmp_path):
    table = reduced(tmp_path, LARGEST_N * RISE, 2 * RISE, failed=True)
    assert table.loc["strength", "value"] == pytest.approx(LARGEST_N / AREA_MM2, rel=0.005)
