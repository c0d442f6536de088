from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from nptcs.calibrate import calibrate_rubber
from nptcs.calibrate.fit import fit_model
from nptcs.calibrate.invariants import NEO_HOOKEAN
from nptcs.calibrate.observations import Observation
from nptcs.config.materials.calibration import CalibrationSettings, RubberSettings
from nptcs.errors import InputError
from nptcs.tables.laboratory.material_card import RubberCard

Make = Callable[..., Any]
SETTINGS = CalibrationSettings()
STRAIN = np.linspace(0, 0.5, 501)


def neo_hookean(c10: float, strain: Any) -> Any:
    stretch = 1 + strain
    return 2 * c10 * (stretch - stretch**-2)


def test_exact_curves_give_their_c10_and_the_scatter_of_specimens(
    make_rubber: Make, make_curve: Make
) -> None:
    truth = [1.15, 1.18, 1.21]
    curves = {
        f"R-{i}": make_curve(STRAIN, neo_hookean(c, STRAIN)) for i, c in enumerate(truth, start=1)
    }
    card = calibrate_rubber("rubber_75A", curves, [make_rubber(n) for n in curves], SETTINGS)
    c10 = card.constants["c10_mpa"]
    assert c10.value == pytest.approx(1.18, rel=1e-12)
    # jackknife of a mean is s/√n
    assert c10.standard_error == pytest.approx(0.03 / np.sqrt(3), rel=1e-9)
    assert c10.specimens == ("R-1", "R-2", "R-3")
    assert "strain 0 to 0.15" in c10.rule
    assert card.model == "neo_hookean"
    assert card.strain_range == (0.0, 0.15)
    assert card.fit_quality["drucker_stable"] == 1.0
    assert card.fit_quality["initial_shear_modulus_mpa"] == pytest.approx(2.36)
    assert RubberCard.model_validate_json(card.model_dump_json()) == card


def test_yeoh_rubber_gives_the_published_c10_in_each_range(
    make_rubber: Make, make_curve: Make
) -> None:
    strain = np.linspace(0, 1.0, 2001)
    stretch = 1 + strain
    i1 = stretch**2 + 2 / stretch - 3
    factor = 1.18 - 2 * 0.15 * i1 + 3 * 0.03 * i1**2
    curves = {"R-1": make_curve(strain, 2 * (stretch - stretch**-2) * factor)}
    for high, published in ((0.05, 1.179), (0.15, 1.169), (1.0, 0.977)):
        settings = CalibrationSettings(rubber=RubberSettings(strain_range=(0.0, high)))
        card = calibrate_rubber("rubber_75A", curves, [make_rubber()], settings)
        assert card.constants["c10_mpa"].value == pytest.approx(published, abs=1e-3)


def test_toe_of_half_a_percent_biases_c10_and_is_found(make_rubber: Make, make_curve: Make) -> None:
    strain = np.linspace(0, 0.3, 601)
    stress = np.where(strain > 0.005, neo_hookean(1.18, strain - 0.005), 0.0)
    curves = {"R-1": make_curve(strain, stress)}
    card = calibrate_rubber("rubber_75A", curves, [make_rubber()], SETTINGS)
    assert card.constants["c10_mpa"].value / 1.18 - 1 == pytest.approx(-0.047, abs=0.001)
    (toe,) = [text for text in card.checks if text.startswith("toe")]
    assert "free strain offset of 0.5 % the neo-Hookean C10 is 1.18 MPa" in toe
    assert "-4.7 %" in toe


def test_left_out_missing_and_single_specimens(make_rubber: Make, make_curve: Make) -> None:
    curves = {
        f"R-{i}": make_curve(STRAIN, neo_hookean(c, STRAIN))
        for i, c in enumerate((1.0, 2.0, 9.0), start=1)
    }
    sheet = [
        make_rubber("R-1"),
        make_rubber("R-2"),
        make_rubber("R-3", include=False, reason="notched"),
        make_rubber("R-4"),
        make_rubber("R-9", material="rubber_88A"),
    ]
    card = calibrate_rubber("rubber_75A", curves, sheet, SETTINGS)
    assert card.constants["c10_mpa"].value == pytest.approx(1.5)
    assert "R-4: no curve, not in the fit" in card.checks
    one = CalibrationSettings(rubber=RubberSettings(only_specimen="R-2"))
    card = calibrate_rubber("rubber_75A", curves, sheet, one)
    assert card.constants["c10_mpa"].value == pytest.approx(2.0)
    assert "too few specimens" in card.constants["c10_mpa"].rule


def test_crosshead_strain_is_named_in_the_card(make_rubber: Make, make_curve: Make) -> None:
    curves = {"R-1": make_curve(STRAIN, neo_hookean(1.18, STRAIN))}
    sources = {"R-1": "crosshead"}
    card = calibrate_rubber("rubber_75A", curves, [make_rubber()], SETTINGS, sources)
    assert "warning: R-1: crosshead strain" in card.checks


def test_weights_decide_how_much_a_specimen_with_more_points_counts(
    make_rubber: Make, make_curve: Make
) -> None:
    dense, coarse = np.linspace(0, 0.15, 1501), np.linspace(0, 0.15, 16)
    curves = {
        "R-1": make_curve(dense, neo_hookean(1.0, dense)),
        "R-2": make_curve(coarse, neo_hookean(2.0, coarse)),
    }
    sheet = [make_rubber("R-1"), make_rubber("R-2")]

    def c10(weights: str) -> float:
        settings = CalibrationSettings(rubber=RubberSettings(weights=weights))
        card = calibrate_rubber("rubber_75A", curves, sheet, settings)
        return card.constants["c10_mpa"].value

    assert c10("specimens") == pytest.approx(1.5, abs=0.02)
    assert c10("points") == pytest.approx(1.01, abs=0.005)
    # relative residuals of c f/P: specimen i counts as 1/C_i²
    assert c10("relative") == pytest.approx((1 / 1 + 1 / 2) / (1 / 1 + 1 / 4), abs=0.02)


def test_errors_name_the_specimen_or_the_key(make_rubber: Make, make_curve: Make) -> None:
    sheet = [make_rubber("R-1")]
    with pytest.raises(InputError, match="material rubber_75A: no curve to fit"):
        calibrate_rubber("rubber_75A", {}, sheet, SETTINGS)
    short = {"R-1": make_curve([0.0, 0.2, 0.4], [0.0, 1.0, 2.0])}
    with pytest.raises(InputError, match=r"specimen R-1.*1 points in the strain range 0 to 0.15"):
        calibrate_rubber("rubber_75A", short, sheet, SETTINGS)
    late = {"R-1": make_curve([0.0, 0.05, 0.1, 0.15, 0.3], [0.0, 0.0, 0.0, 0.0, 2.0])}
    with pytest.raises(
        InputError, match="no stress in the direction of the test in the strain range 0 to 0.15"
    ):
        calibrate_rubber("rubber_75A", late, sheet, SETTINGS)
    with pytest.raises(ValueError, match="must begin at zero strain"):
        RubberSettings(strain_range=(-0.1, 0.15))
    wrong = CalibrationSettings(rubber=RubberSettings(only_specimen="R-7"))
    with pytest.raises(InputError, match="only_specimen"):
        calibrate_rubber("rubber_75A", short, sheet, wrong)


def test_confidence_interval_from_the_scatter_contains_the_truth_in_95_of_100() -> None:
    rng = np.random.default_rng(11)
    stretch, mode = np.linspace(1.0, 1.15, 31), "rubber_tension"
    weight = np.full(31, 1 / 31)
    repetitions, inside = 1000, 0
    for _ in range(repetitions):
        data = []
        for i in range(4):
            c10 = 1.18 * (1 + 0.03 * rng.normal())
            stress = neo_hookean(c10, stretch - 1) + rng.normal(0, 0.003, 31)
            data.append(Observation(f"R-{i}", mode, stretch, stress, weight))
        fit = fit_model(NEO_HOOKEAN, data, 0.1)
        # t(0.975, 3) = 3.182
        inside += abs(fit.constants[0] - 1.18) <= 3.182 * fit.standard_errors[0]
    assert inside / repetitions == pytest.approx(0.95, abs=3 * np.sqrt(0.95 * 0.05 / repetitions))
