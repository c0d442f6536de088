"""Reduction and calibration recover the constants that the synthetic data were made from."""

from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pandas as pd
import pytest
from scipy import stats

from nptcs.calibrate import calibrate_ply, calibrate_rubber
from nptcs.config.materials.calibration import CalibrationSettings
from nptcs.config.materials.ingest import IngestSettings
from nptcs.config.materials.reduction import AstmD3039, AstmD3518, ReductionSettings
from nptcs.example import truth
from nptcs.ingest import Ingested, ingest_specimen, load_profiles
from nptcs.reduce import reduce_record
from nptcs.reduce.groups.statistics import group_statistics
from nptcs.tables.laboratory.material_card import CardConstant
from nptcs.tables.laboratory.specimens import Specimen, read_sheet

ROOT = Path(__file__).resolve().parents[3]
FOLDER = ROOT / "raw_data" / "example"


class Example(NamedTuple):
    """The sheet and the ingested curves of the example data."""

    specimens: list[Specimen]
    ingested: dict[str, Ingested]

    def properties(self, settings: ReductionSettings) -> pd.DataFrame:
        """Reduce every curve."""
        tables = []
        for specimen in self.specimens:
            done = self.ingested[specimen.specimen]
            tables.append(reduce_record(done.curve, specimen, done.record, settings))
        return pd.concat(tables, ignore_index=True)


@pytest.fixture(scope="module")
def example() -> Example:
    specimens, errors = read_sheet(FOLDER / "specimens.csv")
    assert errors == []
    profiles = load_profiles(ROOT / "config" / "formats")
    return Example(
        specimens,
        {s.specimen: ingest_specimen(s, FOLDER, IngestSettings(), profiles) for s in specimens},
    )


def distance(quantity: CardConstant, true_value: float) -> float:
    """Distance from the truth as a fraction of the 95 % interval's half width."""
    assert quantity.standard_error is not None
    half = stats.t.ppf(0.975, len(quantity.specimens) - 1) * quantity.standard_error
    return abs(quantity.value - true_value) / float(half)


def settings(method: Any) -> ReductionSettings:
    return ReductionSettings(
        astm_d3039=AstmD3039(chord_method=method), astm_d3518=AstmD3518(chord_method=method)
    )


@pytest.mark.parametrize("method", ["nearest_points", "interpolated", "least_squares"])
def test_table_2_is_recovered_within_its_stated_uncertainty(example: Example, method: str) -> None:
    properties = example.properties(settings(method))
    card = calibrate_ply(properties, example.specimens, CalibrationSettings())
    table_2 = {
        "e1_mpa": truth.E1_MPA,
        "e2_mpa": truth.E2_MPA,
        "nu12": truth.NU12,
        "g12_mpa": truth.G12_MPA,
    }
    for name, value in table_2.items():
        assert distance(card.constants[name], value) <= 1, name
    # all at once, with their covariance; Hotelling's T² would allow far more than χ²
    assert card.covariance is not None
    error = np.array([card.constants[n].value - table_2[n] for n in card.covariance.names])
    scale = np.sqrt(np.diag(card.covariance.matrix))
    correlation = np.array(card.covariance.matrix) / np.outer(scale, scale)
    squared = (error / scale) @ np.linalg.solve(correlation, error / scale)
    assert squared < stats.chi2.ppf(0.99, 4)
    assert card.synthetic
    assert any("agrees" in check for check in card.checks if check.startswith("reciprocity"))


@pytest.mark.parametrize("rubber", truth.C10_MPA)
def test_c10_is_recovered_within_its_stated_uncertainty(example: Example, rubber: str) -> None:
    curves = {name: ingested.curve for name, ingested in example.ingested.items()}
    card = calibrate_rubber(rubber, curves, example.specimens, CalibrationSettings())
    assert distance(card.constants["c10_mpa"], truth.C10_MPA[rubber]) <= 1
    assert card.synthetic
    assert card.fit_quality["r_squared"] > 0.99


def test_strengths_and_numbers_of_specimens_are_recovered(example: Example) -> None:
    table = group_statistics(
        example.properties(ReductionSettings()), example.specimens, ReductionSettings()
    )
    table = table[table["scope"] == "group"]
    for series in truth.SERIES:
        angle = series.orientation_deg
        group = table[
            (table["test"] == series.test)
            & (table["material"] == series.material)
            & ((table["orientation_deg"] == angle) | (angle is None))
        ].set_index("property")
        left_out = sum(name.startswith(f"{series.prefix}-") for name in truth.LEFT_OUT)
        name = "shear_strength" if series.prefix == "S45" else "strength"
        stated = series.strength_mpa / (2 if series.prefix == "S45" else 1)
        row = group.loc[name]
        assert row["n"] == series.count - left_out
        half = (row["ci95_high"] - row["ci95_low"]) / 2
        # eight groups: one of them may lie outside a 95 % interval, none by half as much again
        assert abs(row["mean"] - stated) <= 1.5 * half, series.prefix
        for specimen, reason in truth.LEFT_OUT.items():
            if specimen.startswith(f"{series.prefix}-"):
                assert f"{specimen}: {reason}" in row["left_out"]


def test_compression_agrees_with_tension_and_its_bending_is_assessed(example: Example) -> None:
    table = group_statistics(
        example.properties(ReductionSettings()), example.specimens, ReductionSettings()
    )
    groups = table[table["scope"] == "group"].set_index(["test", "orientation_deg", "property"])
    for angle, modulus in ((0.0, truth.E1_MPA), (90.0, truth.E2_MPA)):
        row = groups.loc[("compression", angle, "modulus")]
        assert row["ci95_low"] <= modulus <= row["ci95_high"]
        assert abs(groups.loc[("compression", angle, "bending_percent"), "mean"]) < 10
