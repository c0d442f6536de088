"""Bending of laminates and compression of rubber discs, from raw file to value."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pytest
from scipy.integrate import quad

from nptcs.bending import BentBar
from nptcs.calibrate import calibrate_rubber
from nptcs.config.materials.calibration import CalibrationSettings, RubberSettings
from nptcs.config.materials.ingest import IngestSettings
from nptcs.config.materials.reduction import ReductionSettings
from nptcs.ingest import ingest_specimen, load_profiles
from nptcs.reduce import reduce_record, reduce_specimen
from nptcs.tables.laboratory.specimens import Specimen

Make = Callable[..., Any]
ROOT = Path(__file__).resolve().parents[3]
E_MPA = 60_000.0


@pytest.fixture(scope="module")
def profiles() -> Any:
    return load_profiles(ROOT / "config" / "formats")


def bar(**fields: Any) -> Specimen:
    standard: dict[str, Any] = {
        "specimen": "F-1",
        "test": "flexure",
        "material": "cfrp",
        "orientation_deg": 0.0,
        "width_mm": (13.0,) * 3,
        "thickness_mm": (4.0,) * 3,
        "span_mm": 128.0,
        "force_file": "f.csv",
    }
    return Specimen(**(standard | fields))


def by_energy(width: float, h: float, span: float, inner: float, at: float) -> float:
    """Deflection for 1 N at a distance `at` from a support, by Castigliano's theorem (numeric)."""
    arm, stiffness = (span - inner) / 2, E_MPA * width * h**3 / 12

    def moment(x: float) -> float:
        return 0.5 * min(x, arm, span - x)

    def moment_of_unit(x: float) -> float:
        # the unit load shared by both places at distance `at`, as the two rollers are
        return 0.5 * min(x, at, span - x)

    breaks = sorted({arm, at, span - arm, span - at})
    total, _ = quad(lambda x: moment(x) * moment_of_unit(x), 0, span, points=breaks, limit=200)
    return float(total) / stiffness


@pytest.mark.parametrize("inner", [0.0, 64.0, 128.0 / 3])
def test_stress_and_strain_per_unit_are_those_of_a_beam(inner: float) -> None:
    width, h, span = 13.0, 4.0, 128.0
    one = BentBar(width, h, span, inner)
    moment = (span - inner) / 4
    stress = moment * (h / 2) / (width * h**3 / 12)
    assert one.stress_per_force == pytest.approx(stress)
    middle = by_energy(width, h, span, inner, span / 2)
    assert one.strain_per_deflection == pytest.approx(stress / E_MPA / middle, rel=1e-6)
    rollers = by_energy(width, h, span, inner, (span - inner) / 2)
    assert one.strain_per_roller_travel == pytest.approx(stress / E_MPA / rollers, rel=1e-6)


def test_the_standards_own_factors() -> None:
    three, half, third = (BentBar(1, 1, 1, inner) for inner in (0.0, 0.5, 1 / 3))
    assert (three.stress_per_force, three.strain_per_deflection) == pytest.approx((1.5, 6.0))
    # D7264 procedure B: 3PL/(4bh²) and 4.36 hδ/L²; ISO 14125 method B: FL/(bh²) and 4.70
    assert half.stress_per_force == pytest.approx(0.75)
    assert half.strain_per_deflection == pytest.approx(4.36, abs=5e-3)
    assert third.stress_per_force == pytest.approx(1.0)
    assert third.strain_per_deflection == pytest.approx(4.70, abs=5e-3)


def bend(
    folder: Path, specimen: Specimen, profiles: Any, deflection: Any, sign: float, travel: bool
) -> pd.DataFrame:
    """Write the export of a linear bar that breaks, and reduce it."""
    one = specimen.bar
    assert one is not None
    per = one.strain_per_roller_travel if travel else one.strain_per_deflection
    force = E_MPA * per * deflection / one.stress_per_force
    force, deflection = np.append(force, 2.0), np.append(deflection, deflection[-1])
    name = "Displacement (mm)" if travel else "Extension (mm)"
    table = {
        "Time (s)": 0.3 * np.arange(len(force)),
        name: sign * deflection,
        "Load (N)": sign * force,
    }
    pd.DataFrame(table).to_csv(folder / "f.csv", index=False)
    done = ingest_specimen(specimen, folder, IngestSettings(), profiles)
    found = reduce_record(done.curve, specimen, done.record, ReductionSettings())
    return found.set_index("property")


@pytest.mark.parametrize("loading_span_mm", [None, 64.0])
@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_modulus_and_strength_of_a_bent_bar(
    tmp_path: Path, profiles: Any, loading_span_mm: float | None, sign: float
) -> None:
    specimen = bar(loading_span_mm=loading_span_mm)
    deflection = np.linspace(0, 9.0, 400)
    table = bend(tmp_path, specimen, profiles, deflection, sign, travel=True)
    one = specimen.bar
    assert one is not None
    strain = 9.0 * one.strain_per_roller_travel
    assert table.loc["flexural_modulus", "value"] == pytest.approx(E_MPA, rel=1e-3)
    assert table.loc["flexural_strength", "value"] == pytest.approx(E_MPA * strain, rel=1e-3)
    assert table.loc["flexural_strain_at_failure", "value"] == pytest.approx(strain, rel=1e-3)
    points = "4 points, span 128 mm, loading span 64 mm" if loading_span_mm else "3 points, span"
    assert points in table.loc["flexural_strength", "rule"]
    assert "modulus" not in table.index


def test_a_bar_that_is_stopped_has_no_strength(make_curve: Make) -> None:
    strain = np.linspace(0, 0.004, 200)
    table = reduce_specimen(
        make_curve(strain, E_MPA * strain), bar(), ReductionSettings(), "crosshead"
    ).set_index("property")
    assert table.loc["flexural_modulus", "value"] == pytest.approx(E_MPA)
    assert "not assessed: no failure seen" in table.loc["flexural_strength", "flags"]


def test_large_deflection_is_corrected_as_the_standard_says_or_named(make_curve: Make) -> None:
    specimen = bar(span_mm=128.0)
    strain = np.linspace(0, 0.03, 400)
    curve = make_curve(strain, 10_000 * strain)
    deflection = 0.03 * 128 / (6 * 4)  # over the span
    assert deflection == pytest.approx(0.16)

    def strength(standard: Any, source: str = "crosshead", **fields: Any) -> Any:
        settings = ReductionSettings(flexure_standard=standard)
        one = specimen.model_copy(update=fields)
        table = reduce_specimen(curve, one, settings, source, failure_seen=True)
        return table.set_index("property").loc["flexural_strength"]

    d790 = 1 + 6 * deflection**2 - 4 * (4 / 128) * deflection
    assert strength("astm_d790")["value"] == pytest.approx(300 * d790)
    iso = 1 + 6 * deflection**2 - 3 * (4 / 128) * deflection
    assert strength("iso_14125")["value"] == pytest.approx(300 * iso)
    plain = strength("astm_d7264")
    assert plain["value"] == pytest.approx(300)
    assert "ASTM D7264 gives no correction" in plain["flags"]
    gauge = strength("astm_d790", "strain_gauge")
    assert gauge["value"] == pytest.approx(300)
    assert "large deflection not assessed" in gauge["flags"]
    four = strength("iso_14125", loading_span_mm=128.0 / 3)
    assert "gives no correction for this loading" in four["flags"]


def test_spans_outside_the_standard_are_named(make_curve: Make) -> None:
    strain = np.linspace(0, 0.01, 200)
    short = bar(span_mm=64.0, loading_span_mm=30.0)
    table = reduce_specimen(
        make_curve(strain, E_MPA * strain), short, ReductionSettings(), failure_seen=True
    )
    assert table["flags"][:3].str.contains("span to thickness 16, ASTM D7264").all()
    assert table["flags"][:3].str.contains("loading span 0.469 of the span").all()


@pytest.mark.parametrize(
    ("fields", "words"),
    [
        ({"span_mm": None}, "span_mm is empty"),
        ({"loading_span_mm": 130.0}, "loading_span_mm must be smaller"),
        ({"thickness_mm": (), "section_area_mm2": 52.0}, "thickness_mm is empty"),
        ({"test": "tension"}, "span_mm must be empty for a tension test"),
    ],
)
def test_a_bending_row_that_cannot_be_reduced_is_refused(
    fields: dict[str, Any], words: str
) -> None:
    with pytest.raises(ValueError, match=words):
        bar(**fields)


# --- discs -----------------------------------------------------------------------------------


def disc(name: str = "D-1", **fields: Any) -> Specimen:
    standard: dict[str, Any] = {
        "specimen": name,
        "test": "rubber_compression",
        "material": "rubber_75A",
        "diameter_mm": (29.0, 29.0),
        "gauge_length_mm": 12.5,
        "platens": "lubricated",
        "loading": "last",
        "force_file": "d.csv",
    }
    return Specimen(**(standard | fields))


def squeeze(folder: Path, profiles: Any, c10s: list[float], sign: float, **fields: Any) -> Any:
    """Export of a disc that is compressed to 25 % as often as there are constants."""
    ramp = np.linspace(0, 0.25, 120)
    strain = np.concatenate([np.append(ramp, ramp[-2::-1]) for _ in c10s])
    c10 = np.repeat(c10s, 239)
    stretch = 1 - strain
    force = 2 * c10 * (stretch**-2 - stretch) * np.pi / 4 * 29.0**2
    table = {
        "Time (s)": 0.2 * np.arange(len(force)),
        "Displacement (mm)": sign * strain * 12.5,
        "Load (N)": sign * force,
    }
    pd.DataFrame(table).to_csv(folder / "d.csv", index=False)
    specimen = disc(**fields)
    done = ingest_specimen(specimen, folder, IngestSettings(), profiles)
    found = reduce_record(done.curve, specimen, done.record, ReductionSettings())
    return found.set_index("property"), specimen, done


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_a_disc_after_conditioning(tmp_path: Path, profiles: Any, sign: float) -> None:
    table, specimen, done = squeeze(tmp_path, profiles, [1.4, 1.1, 1.0, 1.0], sign)
    assert done.record.geometry.area_mm2 == pytest.approx(np.pi / 4 * 29.0**2)
    at_20 = 2 * (0.8**-2 - 0.8)
    row = table.loc["stress_at_20_percent"]
    assert row["value"] == pytest.approx(at_20, rel=5e-3)
    assert table.loc["compression_modulus_at_20_percent", "value"] == pytest.approx(
        at_20 / 0.2, rel=5e-3
    )
    assert "4 loadings in the record, number 4 taken" in row["flags"]
    assert "of 4 loadings" not in row["flags"]
    assert "strength" not in table.index
    card = calibrate_rubber("rubber_75A", {"D-1": done.curve}, [specimen], CalibrationSettings())
    assert card.constants["c10_mpa"].value == pytest.approx(1.0, rel=5e-3)


def test_missing_conditioning_and_friction_are_reported(tmp_path: Path, profiles: Any) -> None:
    table, _, _ = squeeze(tmp_path, profiles, [1.0], 1.0, platens="")
    flags = table.loc["stress_at_10_percent", "flags"]
    assert "1 of 4 loadings, ISO 7743 measures the last" in flags
    assert "lubrication of the platens not stated" in flags


def test_tension_and_compression_are_fitted_together(make_curve: Make) -> None:
    c10, c01 = 0.8, 0.2

    def stress(stretch: Any) -> Any:
        return 2 * (stretch - stretch**-2) * (c10 + c01 / stretch)

    pull, push = np.linspace(0, 0.6, 120), -np.linspace(0, 0.4, 120)
    curves = {
        "R-1": make_curve(pull, stress(1 + pull)),
        "D-1": make_curve(push, stress(1 + push)),
    }
    tension = Specimen(
        specimen="R-1",
        test="rubber_tension",
        material="rubber_75A",
        width_mm=(6.0,),
        thickness_mm=(2.0,),
        force_file="r.csv",
    )
    settings = CalibrationSettings(
        rubber=RubberSettings(model="mooney_rivlin", strain_range=(0, 0.5))
    )
    both = calibrate_rubber("rubber_75A", curves, [tension, disc(loading="first")], settings)
    found = {name: q.value for name, q in both.constants.items()}
    assert found == pytest.approx({"c10_mpa": c10, "c01_mpa": c01}, rel=1e-6)
    rows = [tension, disc(loading="first", platens="bonded")]
    alone = calibrate_rubber("rubber_75A", curves, rows, settings)
    assert alone.constants["c10_mpa"].specimens == ("R-1",)
    assert any("dry or bonded platens: D-1" in check for check in alone.checks)


# --- other columns of the sheet --------------------------------------------------------------


@pytest.mark.parametrize(
    ("fields", "area"),
    [
        ({"diameter_mm": (10.0, 12.0)}, np.pi / 4 * 121),
        ({"mass_g": 1.5, "length_mm": 100.0, "density_g_per_cm3": 1.5}, 10.0),
        ({"section_area_mm2": 7.0, "diameter_mm": (10.0,)}, 7.0),
        ({"width_mm": (5.0,), "thickness_mm": (2.0,)}, 10.0),
    ],
)
def test_areas(fields: dict[str, Any], area: float) -> None:
    row = Specimen(
        specimen="A", test="tension", material="m", orientation_deg=0, force_file="a.csv", **fields
    )
    assert row.area_mm2 == pytest.approx(area)
    assert row.area_rule


def test_half_a_weighing_is_refused() -> None:
    with pytest.raises(ValueError, match="density_g_per_cm3 is empty"):
        Specimen(
            specimen="A",
            test="tension",
            material="m",
            orientation_deg=0,
            force_file="a.csv",
            mass_g=1.0,
            length_mm=10.0,
        )


def test_factors_scale_force_and_strain(tmp_path: Path, profiles: Any, make_specimen: Make) -> None:
    strain = np.linspace(0, 1.2, 300)
    # a gauge factor entered twice too large, two specimens pulled at once
    table = {
        "Time (s)": 0.3 * np.arange(300),
        "Load (N)": 2 * 15 * 1250 * strain,
        "Strain (%)": 2 * strain,
    }
    pd.DataFrame(table).to_csv(tmp_path / "T0-1.csv", index=False)
    specimen = make_specimen(force_factor=0.5, strain_factor=0.5)
    done = ingest_specimen(specimen, tmp_path, IngestSettings(), profiles)
    found = reduce_record(done.curve, specimen, done.record, ReductionSettings())
    row = found.set_index("property").loc["modulus"]
    assert row["value"] == pytest.approx(125000, rel=1e-3)
    assert "force multiplied by 0.5" in row["flags"]
    assert "strain multiplied by 0.5" in row["flags"]
