"""What is uncertain: groups of the card, scatter against standard error, rubbers, tolerances."""

import numpy as np
import pytest

from nptcs.config.studies.uncertainty import Uncertainty
from nptcs.errors import InputError
from nptcs.tables.analysis.uncertainty import SourceKind
from nptcs.tables.laboratory.material_card import (
    CardConstant,
    Covariance,
    MaterialCard,
    PlyCard,
    RubberCard,
)
from nptcs.uncertainty.inputs import ply_inputs, uncertain_inputs

TENSION, SHEAR = ("T0-1", "T0-2", "T0-3", "T0-4"), ("S45-1", "S45-2")


def quantity(value, specimens=(), equal_to=None):
    return CardConstant(
        value=value,
        unit="MPa",
        standard_error=0.01 * value if specimens else None,
        origin="measured" if specimens else "assumed",
        rule="a rule",
        specimens=specimens,
        equal_to=equal_to,
    )


def ply():
    return PlyCard(
        name="cfrp",
        synthetic=False,
        constants={
            "e1_mpa": quantity(128000.0, TENSION),
            "nu12": quantity(0.36, TENSION),
            "g12_mpa": quantity(3100.0, SHEAR),
            "g13_mpa": quantity(3100.0, equal_to="g12_mpa"),
            "nu23": quantity(0.35),
        },
        covariance=Covariance(
            names=("e1_mpa", "g12_mpa", "nu12"),
            matrix=((4.0e6, 0.0, 3.0), (0.0, 2500.0, 0.0), (3.0, 0.0, 1e-4)),
        ),
    )


def card():
    c10 = quantity(1.2, ("R-1", "R-2", "R-3"))
    rubber = RubberCard(
        name="r75", synthetic=False, constants={"c10_mpa": c10}, strain_range=(0.0, 0.15)
    )
    bare = RubberCard(
        name="bare", synthetic=False, constants={"c10_mpa": quantity(1.0)}, strain_range=(0, 0.1)
    )
    return MaterialCard(plies={"cfrp": ply()}, rubbers={"r75": rubber, "bare": bare})


def test_constants_of_the_same_specimens_vary_together():
    tests, missing = ply_inputs(ply(), "standard_error")
    groups = sorted(one.quantities for one in tests)
    assert groups == [("e1_mpa", "nu12"), ("g12_mpa", "g13_mpa")]
    tension = next(one for one in tests if "e1_mpa" in one.quantities)
    np.testing.assert_allclose(tension.root @ tension.root.T, [[4.0e6, 3.0], [3.0, 1e-4]])
    assert tension.source == "ply cfrp: specimens T0-1, T0-2, T0-3, T0-4"
    shear = next(one for one in tests if "g12_mpa" in one.quantities)
    np.testing.assert_allclose(shear.standard_deviations, [50.0, 50.0])  # G13 follows G12
    assert set(missing) == {"nu23"}


def test_scatter_is_the_standard_error_times_the_root_of_the_number_of_specimens():
    mean, _ = ply_inputs(ply(), "standard_error")
    each, _ = ply_inputs(ply(), "scatter")
    for one, other in zip(mean, each, strict=True):
        count = 4 if "e1_mpa" in one.quantities else 2
        np.testing.assert_allclose(
            other.standard_deviations, np.sqrt(count) * one.standard_deviations
        )


def test_rubbers_are_tested_stated_or_not_assessed():
    settings = Uncertainty(
        tolerances={"thickness_mm": {"sd": 0.05}, "angle_deg": {"plus_minus": 3.0}},
        rubbers={"spoke_c10_mpa": {"rubber": "r75"}},
    )
    values = {"thickness_mm": 1.8, "angle_deg": 45, "spoke_c10_mpa": 2.0, "shear_band_c10_mpa": 5.0}
    found = uncertain_inputs(settings, card(), None, values, ["thickness_mm", "angle_deg"])
    by_name = {one.name: one for one in found.inputs}
    assert by_name["spoke_c10_mpa"].kind is SourceKind.TEST
    # 1 % of the card, applied to 2 MPa
    np.testing.assert_allclose(by_name["spoke_c10_mpa"].standard_deviations, [0.02])
    np.testing.assert_allclose(by_name["angle_deg"].standard_deviations, [3 / np.sqrt(3)])
    assert set(found.not_assessed) == {"shear_band_c10_mpa"}


def test_a_rubber_that_is_a_factor_scatters_in_proportion():
    settings = Uncertainty(rubbers={"spoke_c10_mpa": {"sd_percent": 2}})
    found = uncertain_inputs(settings, card(), None, {"spoke_c10_mpa": 1.0}, ["spoke_c10_mpa"])
    (one,) = found.inputs
    assert one.relative
    assert one.kind is SourceKind.STATED
    np.testing.assert_allclose(one.root, [[0.02]])


@pytest.mark.parametrize(
    ("rubber", "message"), [("none", "no material card"), ("bare", "no standard error")]
)
def test_a_rubber_without_card_or_error_is_refused(rubber, message):
    settings = Uncertainty(rubbers={"spoke_c10_mpa": {"rubber": rubber}})
    with pytest.raises(InputError, match=message):
        uncertain_inputs(settings, card(), None, {"spoke_c10_mpa": 1.0}, [])


def test_settings_that_contradict_themselves_are_refused():
    for values in (
        {"tolerances": {"a": {"sd": 1, "plus_minus": 1}}},
        {"rubbers": {"a": {}}},
        {"samples": 1000},
    ):
        with pytest.raises(ValueError, match=r"give either|power of two"):
            Uncertainty.model_validate(values)
