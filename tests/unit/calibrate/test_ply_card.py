from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
import pandas as pd
import pytest

from nptcs.calibrate import calibrate_ply
from nptcs.config.materials.calibration import (
    CalibrationSettings,
    ConstantSource,
    PlyAssumptions,
    PlySettings,
)
from nptcs.errors import InputError
from nptcs.tables.laboratory.material_card import PLY_CONSTANTS, PlyCard
from nptcs.tables.laboratory.properties import PropertiesTable

Make = Callable[..., Any]
SETTINGS = CalibrationSettings()
E1 = [127000.0, 128000.0, 129500.0, 126500.0, 129000.0]
NU = [0.350, 0.355, 0.366, 0.352, 0.362]
E2 = [8700.0, 8800.0, 8900.0, 8750.0, 8850.0]
G12 = [3100.0, 3150.0, 3200.0, 3120.0, 3165.0]


def rows(names: Sequence[str], values: Sequence[float], **columns: Any) -> pd.DataFrame:
    fields = {
        "material": "cfrp",
        "unit": "MPa",
        "rule": "ASTM chord",
        "range": "strain 0.001 to 0.003",
        "points": 2,
        "flags": "",
        "r_squared": 0.999,
        "standard_error": 1.0,
        "origin": "measured",
        "range_low": 0.001,
        "range_high": 0.003,
        "origin_effect_percent": np.nan,
    }
    table = [
        {**fields, "specimen": n, "value": v, **columns} for n, v in zip(names, values, strict=True)
    ]
    return PropertiesTable.validate(pd.DataFrame(table)[list(PropertiesTable.to_schema().columns)])


def names(prefix: str, n: int = 5) -> list[str]:
    return [f"{prefix}-{i}" for i in range(1, n + 1)]


@pytest.fixture
def properties() -> pd.DataFrame:
    zero = {"test": "tension", "orientation_deg": 0.0}
    return pd.concat(
        [
            rows(names("T0"), E1, property="modulus", **zero),
            rows(names("T0"), NU, property="poisson_ratio", **zero),
            rows(names("T90"), E2, property="modulus", test="tension", orientation_deg=90.0),
            rows(names("S"), G12, property="shear_modulus", test="shear", orientation_deg=45.0),
        ],
        ignore_index=True,
    )


@pytest.fixture
def sheet(make_ply: Make) -> list[Any]:
    return [
        *(make_ply(n, "tension", 0.0) for n in names("T0")),
        *(make_ply(n, "tension", 90.0) for n in names("T90")),
        *(make_ply(n, "shear", 45.0) for n in names("S")),
    ]


def test_measured_constants_are_means_with_their_standard_errors(
    properties: pd.DataFrame, sheet: list[Any]
) -> None:
    card = calibrate_ply(properties, sheet, SETTINGS)
    for name, values in {"e1_mpa": E1, "nu12": NU, "e2_mpa": E2, "g12_mpa": G12}.items():
        quantity = card.constants[name]
        assert quantity.value == pytest.approx(np.mean(values))
        assert quantity.standard_error == pytest.approx(np.std(values, ddof=1) / np.sqrt(5))
        assert quantity.origin == "measured"
        assert len(quantity.specimens) == 5
    assert tuple(card.constants) == PLY_CONSTANTS
    assert card.constants["e1_mpa"].unit == "MPa"
    assert card.constants["nu12"].unit == "1"
    assert "mean of 5, tension 0 degrees" in card.constants["e1_mpa"].rule
    assert PlyCard.model_validate_json(card.model_dump_json()) == card


def test_assumptions_are_numbers_or_ties_and_say_so(
    properties: pd.DataFrame, sheet: list[Any]
) -> None:
    card = calibrate_ply(properties, sheet, SETTINGS)
    assert card.constants["e3_mpa"].value == card.constants["e2_mpa"].value
    assert card.constants["e3_mpa"].equal_to == "e2_mpa"
    assert card.constants["g13_mpa"].equal_to == "g12_mpa"
    assert card.constants["nu13"].rule == "assumed equal to nu12"
    assert (card.constants["nu23"].value, card.constants["g23_mpa"].value) == (0.35, 2300.0)
    assert card.constants["g23_mpa"].standard_error is None
    own = CalibrationSettings(ply=PlySettings(assumptions=PlyAssumptions(e3_mpa=9000.0)))
    card = calibrate_ply(properties, sheet, own)
    assert card.constants["e3_mpa"].value == 9000.0
    assert card.constants["e3_mpa"].equal_to is None


def test_covariance_links_constants_of_the_same_specimens_only(
    properties: pd.DataFrame, sheet: list[Any]
) -> None:
    covariance = calibrate_ply(properties, sheet, SETTINGS).covariance
    assert covariance is not None
    assert covariance.names == ("e1_mpa", "e2_mpa", "nu12", "g12_mpa")
    assert covariance.units == ("MPa", "MPa", "1", "MPa")
    matrix = np.array(covariance.matrix)
    assert matrix[0, 2] == pytest.approx(np.cov(E1, NU)[0, 1] / 5)
    assert matrix[0, 0] == pytest.approx(np.var(E1, ddof=1) / 5)
    assert matrix[0, 1] == matrix[0, 3] == matrix[1, 2] == 0.0
    assert np.linalg.eigvalsh(matrix).min() >= 0
    assert "different specimens: zero" in covariance.rule
    assert "the 5 shared specimens" in covariance.rule


def test_partly_shared_specimens_correlate_less(properties: pd.DataFrame, sheet: list[Any]) -> None:
    lacking = (properties["specimen"] == "T0-5") & (properties["property"] == "poisson_ratio")
    covariance = calibrate_ply(properties[~lacking], sheet, SETTINGS).covariance
    assert covariance is not None
    r = np.corrcoef(E1[:4], NU[:4])[0, 1]
    expected = r * np.std(E1, ddof=1) * np.std(NU[:4], ddof=1) * 4 / (5 * 4)
    assert np.array(covariance.matrix)[0, 2] == pytest.approx(expected)


def test_left_out_specimens_do_not_enter(
    properties: pd.DataFrame, sheet: list[Any], make_ply: Make
) -> None:
    sheet[0] = make_ply("T0-1", "tension", 0.0, include=False, reason="slipped")
    card = calibrate_ply(properties, sheet, SETTINGS)
    assert card.constants["e1_mpa"].value == pytest.approx(np.mean(E1[1:]))
    assert "T0-1" not in card.constants["e1_mpa"].specimens


def test_sources_can_be_other_tests_or_several(
    properties: pd.DataFrame, sheet: list[Any], make_ply: Make
) -> None:
    more = rows(["C-1"], [118000.0], property="modulus", test="compression", orientation_deg=0.0)
    both = ConstantSource(tests=("tension", "compression"), orientation_deg=0, property="modulus")
    settings = CalibrationSettings(ply=PlySettings(e1_mpa=both))
    card = calibrate_ply(
        pd.concat([properties, more]), [*sheet, make_ply("C-1", "compression", 0.0)], settings
    )
    assert card.constants["e1_mpa"].value == pytest.approx(np.mean([*E1, 118000.0]))
    assert "tension+compression 0 degrees" in card.constants["e1_mpa"].rule


def test_synthetic_specimens_make_a_synthetic_card(
    properties: pd.DataFrame, sheet: list[Any], make_ply: Make
) -> None:
    assert not calibrate_ply(properties, sheet, SETTINGS).synthetic
    sheet[0] = make_ply("T0-1", "tension", 0.0, origin="synthetic")
    assert calibrate_ply(properties, sheet, SETTINGS).synthetic


def test_missing_source_names_constant_and_reason(
    properties: pd.DataFrame, sheet: list[Any]
) -> None:
    gone = properties["property"] == "shear_modulus"
    with pytest.raises(InputError, match=r"calibration\.ply\.g12_mpa.*no shear_modulus from shear"):
        calibrate_ply(properties[~gone], sheet, SETTINGS)
    unknown = properties.assign(
        value=properties["value"].mask(gone),
        flags=np.where(gone, "not assessed: no transverse strain", ""),
    )
    with pytest.raises(InputError, match="not assessed: no transverse strain"):
        calibrate_ply(unknown, sheet, SETTINGS)


def test_one_specimen_has_no_error_and_the_card_says_so(
    properties: pd.DataFrame, sheet: list[Any]
) -> None:
    few = properties[~properties["specimen"].isin(["S-2", "S-3", "S-4", "S-5"])]
    card = calibrate_ply(few, sheet, SETTINGS)
    assert card.constants["g12_mpa"].standard_error is None
    assert card.covariance is not None
    assert "g12_mpa" not in card.covariance.names
    assert "g12_mpa: one specimen, no standard error" in card.checks


def test_crosshead_strain_is_named_in_the_card(properties: pd.DataFrame, sheet: list[Any]) -> None:
    said = properties["test"].eq("shear").map({True: "crosshead strain: x", False: ""})
    card = calibrate_ply(properties.assign(flags=said), sheet, SETTINGS)
    assert any("g12_mpa is based on crosshead strain" in c and "S-3" in c for c in card.checks)
    assert not any("e1_mpa rests" in check for check in card.checks)


def test_a_constant_rests_on_sensors_alone_where_there_are_some(
    properties: pd.DataFrame, sheet: list[Any]
) -> None:
    travel = properties["specimen"] == "S-3"
    soft = properties.assign(
        flags=travel.map({True: "crosshead strain: x", False: ""}),
        value=properties["value"].where(~travel, properties["value"] / 3),
    )
    card = calibrate_ply(soft, sheet, SETTINGS)
    without = calibrate_ply(properties[~travel], sheet, SETTINGS)
    assert card.constants["g12_mpa"] == without.constants["g12_mpa"]
    assert not any("is based on crosshead" in check for check in card.checks)


def test_a_constant_of_two_tests_takes_no_travel_of_one_next_to_sensors_of_the_other(
    properties: pd.DataFrame, make_ply: Make, sheet: list[Any]
) -> None:
    """Each test by itself is consistent: the mixture is in the constant's source."""
    pressed = rows(
        names("C0"), [value / 3 for value in E1], property="modulus", test="compression",
        orientation_deg=0.0, flags="crosshead strain: x",
    )  # fmt: skip
    both = ConstantSource(property="modulus", tests=("tension", "compression"), orientation_deg=0.0)
    settings = CalibrationSettings(ply=PlySettings(e1_mpa=both))
    table = pd.concat([properties, pressed], ignore_index=True)
    card = calibrate_ply(table, sheet + [make_ply(n, "compression", 0.0) for n in names("C0")],
                         settings)  # fmt: skip
    assert card.constants["e1_mpa"].value == pytest.approx(np.mean(E1))
    assert card.constants["e1_mpa"].specimens == tuple(names("T0"))
    (said,) = [check for check in card.checks if "e1_mpa: left out" in check]
    assert "crosshead strain" in said
    assert "C0-1" in said


def test_measured_nu21_is_compared_with_reciprocity(
    properties: pd.DataFrame, sheet: list[Any]
) -> None:
    across = {"property": "poisson_ratio", "test": "tension", "orientation_deg": 90.0}
    # nu12 E2/E1 = 0.02454
    good = rows(names("T90"), [0.024, 0.025, 0.0245, 0.0243, 0.0249], **across)
    wrong = rows(names("T90"), [0.040, 0.041, 0.0405, 0.0403, 0.0409], **across)
    for table, words in ((good, ": agrees"), (wrong, "warning: does not agree")):
        card = calibrate_ply(pd.concat([properties, table]), sheet, SETTINGS)
        (check,) = [c for c in card.checks if c.startswith("reciprocity")]
        assert words in check
    (check,) = [c for c in calibrate_ply(properties, sheet, SETTINGS).checks if "nu21" in c]
    assert "nu21 was not measured" in check


def test_two_composites_need_a_name(
    properties: pd.DataFrame, sheet: list[Any], make_ply: Make
) -> None:
    more = [*sheet, make_ply("X-1", "tension", 0.0, material="gfrp")]
    with pytest.raises(InputError, match="2 composites"):
        calibrate_ply(properties, more, SETTINGS)
    assert calibrate_ply(properties, more, SETTINGS, "cfrp").name == "cfrp"
