"""Axes, signs, and each conditioning step against manufactured signals."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from nptcs.config.materials.ingest import (
    EndOfTest,
    ExtensometerRemoval,
    ForceZero,
    IngestSettings,
    MissingValues,
    OriginOfStrain,
    Signs,
)
from nptcs.errors import InputError
from nptcs.ingest.conditioning.plausible import check_physics
from nptcs.ingest.conditioning.sensors import empty_after_removal
from nptcs.ingest.conditioning.signals import Signals
from nptcs.ingest.conditioning.signs import orient
from nptcs.ingest.conditioning.steps import (
    cut_end,
    drop_empty_rows,
    empty_spikes,
    mark_dead,
    zero_force,
)
from nptcs.ingest.conditioning.strain_origin import correct_origin
from nptcs.ingest.conditioning.strains import resolve_strains

PATH = Path("a.csv")
FORCE = np.linspace(0, 1000, 101)
NAMES = {"strain_xx": "exx", "strain_yy": "eyy", "strain": "strain", "displacement": "travel"}


def resolve(specimen, source="unspecified", compliance=None, **channels):
    signals = Signals({"force": FORCE, **channels})
    source = resolve_strains(signals, specimen, NAMES, source, compliance, PATH)
    return signals, source


@pytest.mark.parametrize("axial", ["strain_xx", "strain_yy"])
def test_axial_strain_is_found_whatever_the_camera_s_orientation(coupon, axial):
    other = {"strain_xx": "strain_yy", "strain_yy": "strain_xx"}[axial]
    signals, source = resolve(coupon(), **{axial: 1e-5 * FORCE, other: -3e-6 * FORCE})
    assert signals.values["strain_axial"] == pytest.approx(1e-5 * FORCE)
    assert signals.values["strain_transverse"] == pytest.approx(-3e-6 * FORCE)
    assert source == "dic"


def test_stated_axis_that_data_contradict_is_refused(coupon):
    with pytest.raises(InputError, match="other strain is larger"):
        resolve(coupon(strain_axis="exx"), strain_xx=-3e-6 * FORCE, strain_yy=1e-5 * FORCE)


def test_strains_too_alike_need_a_stated_axis(coupon):
    alike = {"strain_xx": 1e-5 * FORCE, "strain_yy": -0.95e-5 * FORCE}
    with pytest.raises(InputError, match="cannot be told"):
        resolve(coupon(), **alike)
    signals, _ = resolve(coupon(strain_axis="eyy"), **alike)
    assert signals.values["strain_axial"][-1] < 0


def test_unknown_axis_is_refused(coupon):
    with pytest.raises(InputError, match="not a strain of the file"):
        resolve(coupon(strain_axis="ezz"), strain_xx=1e-5 * FORCE, strain_yy=-3e-6 * FORCE)


def test_strain_that_is_travel_over_a_length_is_called_crosshead(coupon):
    travel = 1e-3 * FORCE**1.1
    signals, source = resolve(
        coupon(), source="extensometer", strain=travel / 80, displacement=travel
    )
    assert source == "crosshead"
    assert any("crosshead strain" in flag for flag in signals.flags)


def test_an_independent_strain_is_not_called_crosshead(coupon):
    travel = 1e-3 * FORCE**1.1
    _, source = resolve(coupon(), source="extensometer", strain=1e-5 * FORCE, displacement=travel)
    assert source == "extensometer"


def test_machine_compliance_is_taken_out(coupon):
    specimen = coupon()
    travel = 50 * 1e-5 * FORCE + 4e-4 * FORCE
    plain, source = resolve(specimen, displacement=travel)
    corrected, _ = resolve(specimen, compliance=4e-4, displacement=travel)
    assert source == "crosshead"
    assert plain.values["strain_axial"][-1] == pytest.approx(1.8 * 0.01)
    assert corrected.values["strain_axial"] == pytest.approx(1e-5 * FORCE)


SHEAR = {"test": "shear", "orientation_deg": 45}


@pytest.mark.parametrize("test", [{}, SHEAR], ids=["tension", "shear"])
def test_an_extension_always_needs_a_gauge_length(coupon, test):
    with pytest.raises(InputError, match="gauge_length_mm is empty"):
        resolve(coupon(gauge_length_mm=None, **test), extension=FORCE)


@pytest.mark.parametrize("test", [{}, SHEAR], ids=["tension", "shear"])
def test_travel_without_a_length_leaves_the_strain_empty(coupon, test):
    signals, source = resolve(coupon(gauge_length_mm=None, **test), displacement=FORCE)
    assert source == "none"
    assert np.isnan(signals.values["strain_axial"]).all()


@pytest.mark.parametrize("force_sign", [1, -1])
@pytest.mark.parametrize("strain_sign", [1, -1])
def test_compression_is_negative_whatever_the_machine_writes(coupon, force_sign, strain_sign):
    specimen = coupon(test="compression")
    signals, _ = resolve(specimen, strain=strain_sign * 1e-5 * FORCE)
    signals.values["force"] = force_sign * FORCE
    orient(signals, specimen, PATH, Signs())
    assert signals.values["force"][-1] == -1000
    assert signals.values["strain_axial"][-1] == pytest.approx(-0.01)


def test_tension_specimen_that_shortens_is_refused(coupon):
    signals, _ = resolve(coupon(), strain=-1e-5 * FORCE)
    with pytest.raises(InputError, match="falls while a tension test"):
        orient(signals, coupon(), PATH, Signs())


def conditioned(strain, force=FORCE, transverse=None):
    nothing = np.full(len(force), np.nan)
    return Signals(
        {
            "force": np.array(force, dtype=float),
            "stress": np.array(force, dtype=float) / 10,
            "strain_axial": np.array(strain, dtype=float),
            "strain_transverse": nothing if transverse is None else transverse,
            "strain_axial_back": nothing.copy(),
        }
    )


def test_dead_values_and_dead_channels_go():
    strain = 1e-5 * FORCE.copy()
    strain[7] = -1e6
    signals = Signals({"force": FORCE, "strain": strain, "strain_transverse": np.full(101, 3.0)})
    mark_dead(signals, MissingValues())
    assert np.isnan(signals.values["strain"][7])
    assert "strain_transverse" not in signals.values
    assert signals.steps[-1].numbers["emptied"] == 1


@pytest.mark.parametrize("wild", [51234.0, -400.0])
def test_a_wild_reading_is_emptied_and_reported(wild):
    force = FORCE.copy()
    force[40] = wild
    signals = Signals({"force": force, "strain": 1e-5 * FORCE.copy()})
    empty_spikes(signals, MissingValues())
    assert np.flatnonzero(np.isnan(signals.values["force"])).tolist() == [40]
    assert signals.steps[-1].numbers == {"force_reading_41": wild}
    assert any("wild" in flag for flag in signals.flags)


def test_failure_and_noise_are_not_spikes():
    noise = np.random.default_rng(1).standard_normal(101)
    force = np.concatenate([FORCE + noise, [5.0, 4.0, 6.0]])
    signals = Signals({"force": force})
    empty_spikes(signals, MissingValues())
    assert not np.isnan(signals.values["force"]).any()


def test_frames_without_strain_go_but_strength_stays():
    strain = 1e-5 * FORCE.copy()
    strain[[3, 4]] = np.nan
    strain[80:] = np.nan
    signals = conditioned(strain)
    drop_empty_rows(signals, MissingValues())
    assert len(signals) == 99
    assert signals.values["force"].max() == 1000


def test_what_follows_failure_is_cut():
    force = np.concatenate([FORCE, [300.0, 20.0, 20.0]])
    signals = conditioned(1e-5 * np.arange(104), force)
    cut_end(signals, EndOfTest())
    assert len(signals) == 101
    assert signals.values["force"][-1] == 1000


def test_a_drop_before_the_peak_is_not_the_end():
    force = np.concatenate([FORCE[:50], [100.0], FORCE[50:]])
    signals = conditioned(1e-5 * np.arange(102), force)
    cut_end(signals, EndOfTest())
    assert len(signals) == 102


@pytest.mark.parametrize("after", [0.0, -0.005, 0.2])
def test_extensometer_taken_off_is_found(after):
    strain = 1e-5 * FORCE.copy()
    strain[60:] = after
    signals = conditioned(strain)
    empty_after_removal(signals, ExtensometerRemoval(), rubber=False, source="")
    assert np.isnan(signals.values["strain_axial"][60:]).all()
    assert not np.isnan(signals.values["strain_axial"][:60]).any()
    assert signals.values["force"].max() == 1000
    assert any("extensometer removed or slipped" in flag for flag in signals.flags)


def test_extensometer_that_stands_still_is_found():
    strain = np.minimum(1e-5 * FORCE, 0.006)
    signals = conditioned(strain)
    empty_after_removal(signals, ExtensometerRemoval(), rubber=False, source="")
    measured = np.flatnonzero(~np.isnan(signals.values["strain_axial"]))
    assert 60 <= measured[-1] <= 66


def test_slip_is_found():
    strain = 1e-5 * FORCE.copy()
    strain[60:] -= 0.003
    signals = conditioned(strain)
    empty_after_removal(signals, ExtensometerRemoval(), rubber=False, source="")
    assert np.isnan(signals.values["strain_axial"][60:]).all()


@pytest.mark.parametrize("seed", range(10))
def test_noise_is_not_a_removal(seed):
    noise = 3e-5 * np.random.default_rng(seed).standard_normal(101)
    signals = conditioned(1e-5 * FORCE + noise)
    empty_after_removal(signals, ExtensometerRemoval(), rubber=False, source="")
    assert not np.isnan(signals.values["strain_axial"]).any()


def test_a_drop_of_the_force_with_the_strain_is_not_a_removal():
    strain, force = 1e-5 * FORCE.copy(), FORCE.copy()
    strain[60:] -= 0.002
    force[60:] -= 200
    signals = conditioned(strain, force)
    empty_after_removal(signals, ExtensometerRemoval(), rubber=False, source="")
    assert not np.isnan(signals.values["strain_axial"]).any()


def test_a_leap_with_a_loss_of_force_is_damage_and_not_a_removal():
    force = np.linspace(0, 1000, 21)
    strain = 1e-5 * force
    strain[12:] += 0.011
    force[12:] -= 150
    signals = conditioned(strain, force)
    empty_after_removal(signals, ExtensometerRemoval(), rubber=False, source="")
    assert not np.isnan(signals.values["strain_axial"]).any()


def test_untared_load_cell():
    signals = conditioned(1e-5 * FORCE, FORCE + 25)
    signals.values["force"][:10] = 25
    zero_force(signals, ForceZero(enabled=True))
    assert signals.values["force"][-1] == pytest.approx(1000)


E_MPA = 70_000.0


def test_the_strain_of_a_preload_is_restored():
    stress = np.linspace(20, 700, 200)
    strain = stress / E_MPA - 20 / E_MPA
    signals = conditioned(strain, 10 * stress, -0.3 * strain)
    correct_origin(signals, OriginOfStrain(), rubber=False)
    assert signals.values["strain_axial"] == pytest.approx(stress / E_MPA, abs=1e-9)
    assert signals.values["strain_transverse"] == pytest.approx(-0.3 * stress / E_MPA, abs=1e-9)


def test_toe_is_shifted_and_cut():
    stress = np.linspace(0, 700, 400)
    strain = stress / E_MPA + 0.001 * (1 - np.exp(-stress / 4))
    signals = conditioned(strain, 10 * stress)
    correct_origin(signals, OriginOfStrain(), rubber=False)
    strain, stress = signals.values["strain_axial"], signals.values["stress"]
    assert strain == pytest.approx(stress / E_MPA, abs=2e-6)
    assert signals.steps[-1].numbers["toe_rows"] > 3


@pytest.mark.parametrize("seed", range(5))
def test_a_clean_curve_is_not_moved_by_its_noise(seed):
    stress = np.linspace(0, 700, 400)
    noise = 2e-5 * np.random.default_rng(seed).standard_normal(400)
    signals = conditioned(stress / E_MPA + noise, 10 * stress)
    correct_origin(signals, OriginOfStrain(), rubber=False)
    numbers = signals.steps[-1].numbers
    assert "shift_strain_axial" not in numbers
    assert abs(numbers["found"]) <= 3 * np.hypot(numbers["standard_error"], numbers["model_error"])
    assert np.array_equal(signals.values["strain_axial"], stress / E_MPA + noise)
    # with a limit of zero the same shift is applied, and says how sure it is
    signals = conditioned(stress / E_MPA + noise, 10 * stress)
    correct_origin(signals, OriginOfStrain(significance=0), rubber=False)
    shifted = signals.steps[-1].numbers
    assert shifted["shift_strain_axial"] == pytest.approx(numbers["found"])
    assert shifted["standard_error"] == pytest.approx(numbers["standard_error"])


@pytest.mark.parametrize("toe", [0.0, 0.005])
def test_rubber_is_not_biased_by_its_curvature(toe):
    strain = np.linspace(0, 0.8, 800)
    stress = 2 * 1.18 * ((1 + strain) - (1 + strain) ** -2)
    signals = conditioned(strain + toe * (1 - np.exp(-stress / 0.01)), 10 * stress)
    correct_origin(signals, OriginOfStrain(), rubber=True)
    measured, stress = signals.values["strain_axial"], signals.values["stress"]
    shape = 2 * ((1 + measured) - (1 + measured) ** -2)
    used = measured < 0.15
    c10 = (shape * stress)[used].sum() / (shape**2)[used].sum()
    assert c10 == pytest.approx(1.18, rel=2e-3)


def test_compression_keeps_its_sign():
    stress = -np.linspace(20, 700, 200)
    signals = conditioned(stress / E_MPA + 20 / E_MPA, 10 * stress)
    correct_origin(signals, OriginOfStrain(), rubber=False)
    assert signals.values["strain_axial"] == pytest.approx(stress / E_MPA, abs=1e-9)


def test_origin_that_cannot_be_found_is_flagged():
    stress = np.linspace(0, 700, 6)
    signals = conditioned(stress / E_MPA, 10 * stress)
    correct_origin(signals, OriginOfStrain(), rubber=False)
    assert any("not corrected" in flag for flag in signals.flags)
    assert signals.values["strain_axial"] == pytest.approx(stress / E_MPA)


def test_steps_that_are_off_change_nothing_and_say_so():
    off = IngestSettings.as_recorded()
    signals = conditioned(1e-5 * FORCE)
    before = signals.values["strain_axial"].copy()
    mark_dead(signals, off.missing_values)
    empty_spikes(signals, off.missing_values)
    drop_empty_rows(signals, off.missing_values)
    zero_force(signals, off.force_zero)
    cut_end(signals, off.end_of_test)
    empty_after_removal(signals, off.extensometer, rubber=False, source="")
    correct_origin(signals, off.strain_origin, rubber=False)
    assert (signals.values["strain_axial"] == before).all()
    assert [step.on for step in signals.steps] == [False] * 7


@pytest.mark.parametrize(
    ("strain", "message"),
    [(1e-3 * FORCE, "beyond 0.5"), (1e-8 * FORCE, "apparent modulus"), (4e-4 * FORCE, "modulus")],
)
def test_what_physics_forbids_is_refused(coupon, strain, message):
    with pytest.raises(InputError, match=message):
        check_physics(conditioned(strain), coupon(), _tables(), IngestSettings().plausible)


class _Table:
    path = PATH
    units = {"force": "N", "strain": "1"}
    assumed = ()


def _tables():
    return [_Table()]
