"""Settlement of the layers under waves of pressure, and the ring that is matched to it."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.linalg import expm

from nptcs.config.solvers.tyre import TyreGeometry
from nptcs.ring.pressure_waves import (
    HALF_WAVES,
    RubberLayer,
    WireSheet,
    drift,
    foot_squeeze,
    matched_thickening,
    missing_drift,
    settlement,
)
from nptcs.ring.rubber import Rubber

WAVE = np.pi / np.array([10.0, 25.0, 80.0])
RIGID = WireSheet(1e12, 1e18, 0.0)
FOOT_MM = 16.0


@pytest.mark.parametrize("ratio", [10.0, np.inf])
def test_transfer_through_a_layer_is_the_exponential(ratio):
    rubber = Rubber(5.0, ratio)
    found = RubberLayer(rubber, 12.5).transfer(WAVE)
    for q, own in zip(WAVE, found, strict=True):
        equations = np.array(
            [
                [0.0, q, 1 / rubber.shear_mpa, 0.0],
                [-rubber.contraction * q, 0.0, 0.0, rubber.through_compliance_per_mpa],
                [rubber.along_mpa * q**2, 0.0, 0.0, rubber.contraction * q],
                [0.0, 0.0, -q, 0.0],
            ]
        )
        np.testing.assert_allclose(own, expm(12.5 * equations), rtol=1e-9, atol=1e-12)


def test_two_layers_of_the_same_rubber_are_one():
    rubber = Rubber(2.0, 10.0)
    both = RubberLayer(rubber, 4.0).transfer(WAVE) @ RubberLayer(rubber, 7.0).transfer(WAVE)
    np.testing.assert_allclose(both, RubberLayer(rubber, 11.0).transfer(WAVE), rtol=1e-9)


@pytest.mark.parametrize("ratio", [10.0, np.inf])
def test_short_waves_settle_as_a_half_space(ratio):
    rubber = Rubber(5.0, ratio)
    poisson = rubber.contraction / (1 + rubber.contraction)
    wave = np.array([1.0])
    found = settlement([RIGID, RubberLayer(rubber, 9.0)], wave)
    assert found[0] == pytest.approx((1 - poisson) / rubber.shear_mpa, rel=1e-3)


def test_long_waves_press_a_held_layer_as_a_confined_one():
    rubber = Rubber(5.0, 10.0)
    found = settlement([RIGID, RubberLayer(rubber, 9.0)], np.array([1e-3]))
    assert found[0] == pytest.approx(9.0 * rubber.through_compliance_per_mpa, rel=1e-3)


def test_wires_bend_as_a_beam_under_long_waves():
    sheet, wave = WireSheet(1e4, 5e3, 0.0), np.array([0.05])
    found = settlement([sheet, RubberLayer(Rubber(1e-3, 10.0), 1e-4)], wave)
    assert found[0] == pytest.approx(1 / (5e3 * 0.05**4), rel=1e-3)


def flat_ring(ratio, thickening=None):
    """The published section, and its layers, as the section hands them over."""
    from nptcs.ring import section

    caught = {}

    def keep(ring, layers, depth):
        caught.update(ring=ring, layers=layers, depth=depth)
        return 0.0 if thickening is None else thickening

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(section, "matched_thickening", keep)
        section.ring_section(TyreGeometry(), Rubber(5.0, ratio), Rubber(5.0, ratio), 0.05, FOOT_MM)
    return caught["ring"], caught["layers"], caught["depth"]


def misfit(ring, layers, depth, change):
    wave = np.pi / (HALF_WAVES * depth)
    least, linear, square = ring.settlement(wave)
    return least + linear * change + square * change**2 - settlement(layers, wave)


def test_free_edges_settle_too_much_without_the_match():
    ring, layers, depth = flat_ring(10.0)
    before, change = misfit(ring, layers, depth, 0.0), matched_thickening(ring, layers, depth)
    after = misfit(ring, layers, depth, change)
    # 0.06 mm per MPa too soft where the contact is as short as the tread is deep
    assert before[:2].min() > 0.05
    assert np.abs(after).max() < 0.5 * np.abs(before).max()
    near = [np.sum(misfit(ring, layers, depth, change + d) ** 2) for d in (-0.01, 0.0, 0.01)]
    assert near[1] < min(near[0], near[2])


class HeldRing:
    """A ring that does not move."""

    width_mm = 200.0

    def inner_settlement(self, wave):
        return 0.0 * wave


@pytest.mark.parametrize("moved", [False, True])
def test_a_wide_foot_squeezes_a_held_layer_as_a_confined_one(moved):
    """80 layers wide: the edges count for little, and F and M press what is under the foot."""
    rubber, depth, width = Rubber(5.0, 10.0), 1.0, 80.0
    ring = HeldRing()
    soft = depth * rubber.through_compliance_per_mpa / ring.width_mm
    ring.inner_settlement = lambda wave: (0.4 if moved else 0.0) * soft * ring.width_mm + 0.0 * wave
    # the wires are the ground: nothing moves on the other side of the layer
    found = foot_squeeze(ring, [RubberLayer(rubber, depth), RIGID], 500.0, width)
    part = 0.6 if moved else 1.0
    assert found[0] == pytest.approx(part * soft / width, rel=0.03)
    assert found[1] == pytest.approx(part * soft / (width**3 / 12), rel=0.1)


def test_the_band_under_a_foot_gives_more_than_its_confined_core():
    ring, layers, depth = flat_ring(10.0)
    rubber = Rubber(5.0, 10.0)
    found = foot_squeeze(ring, layers, depth, FOOT_MM)
    # from the inner face to the mean of a core that is pulled at its inner face, and the cover
    confined = (2 / 3 * ring.half_distance_mm + 0.75) * rubber.through_compliance_per_mpa
    assert 1.0 < found[0] * ring.width_mm * FOOT_MM / confined < 2.0
    assert foot_squeeze(ring, layers, depth, 2 * FOOT_MM)[0] < found[0]


def test_incompressible_rubber_needs_next_to_no_match():
    ring, layers, depth = flat_ring(np.inf)
    change = matched_thickening(ring, layers, depth)
    assert abs(change) < 0.01 * abs(ring.thickening[2])


def test_the_quadratic_is_the_settlement_of_the_changed_ring():
    ring, _, _ = flat_ring(10.0)
    least, linear, square = ring.settlement(WAVE)
    changed = replace(ring, thickening=ring.thickening + [0, 0, 0.7])
    expected = changed.settlement(WAVE)[0]
    np.testing.assert_allclose(least + 0.7 * linear + 0.49 * square, expected, rtol=1e-10)


def test_long_waves_bend_the_ring_as_the_layers():
    """Sandwich and exact layers: the wires' shear is not in series with the core's."""
    ring, layers, _ = flat_ring(np.inf)
    wave = np.pi / np.array([300.0, 600.0])
    assert ring.settlement(wave)[0] == pytest.approx(settlement(layers, wave), rel=1e-3)


@pytest.mark.parametrize("ratio", [10.0, np.inf])
def test_short_waves_of_shear_drift_as_a_half_space(ratio):
    rubber = Rubber(5.0, ratio)
    wave = np.pi / np.array([1.5, 2.5])
    # plane strain (Johnson, Contact Mechanics): 2 (1 - ν²)/(E q) = (1 - ν)/(G q)
    poisson = rubber.contraction / (1 + rubber.contraction)
    expected = (1 - poisson) / (rubber.shear_mpa * wave)
    found = drift([RIGID, RubberLayer(rubber, 20.0)], wave)
    np.testing.assert_allclose(found, expected, rtol=1e-4)


def test_long_waves_of_shear_shear_the_tread_evenly():
    rubber = Rubber(5.0, 10.0)
    (found,) = drift([RIGID, RubberLayer(rubber, 10.0)], np.array([np.pi / 5000.0]))
    assert found == pytest.approx(10.0 / rubber.shear_mpa, rel=1e-3)


def test_the_ring_lacks_a_quarter_of_the_tread_s_shear_in_long_waves():
    ring, layers, _ = flat_ring(10.0)
    wave = np.array([np.pi / 2000.0])
    missing = drift(layers, wave) - ring.drift(wave)
    quarter = ring.surface_mm / 4.0 / (2.0 * 5.0)
    assert missing[0] == pytest.approx(quarter, rel=0.05)
    ring, layers, depth = flat_ring(10.0)
    assert 0.5 * quarter < missing_drift(ring, layers, depth) < 0.8 * quarter
