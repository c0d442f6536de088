"""The section against closed forms."""

import numpy as np
import pytest

from nptcs.config.solvers.tyre import TyreGeometry
from nptcs.ring.rubber import Rubber
from nptcs.ring.section import ring_section

SOFT_WIRES = TyreGeometry(wire_modulus_mpa=1e-9)
BAND = Rubber(5.0, np.inf)
FOOT_MM = 16.0


def test_rubber_moduli_are_those_of_plane_strain():
    rubber = Rubber(5.0, 10.0)
    shear, bulk = 10.0, 100.0
    young = 9 * bulk * shear / (3 * bulk + shear)
    poisson = (3 * bulk - 2 * shear) / (2 * (3 * bulk + shear))
    assert rubber.along_mpa == pytest.approx(young / (1 - poisson**2))
    assert rubber.contraction == pytest.approx(poisson / (1 - poisson))
    assert rubber.through_compliance_per_mpa == pytest.approx(1 / (bulk + 4 * shear / 3))
    assert BAND.along_mpa == pytest.approx(8 * 5.0)
    assert BAND.contraction == 1.0
    assert BAND.through_compliance_per_mpa == 0.0


@pytest.mark.parametrize("row_mm", [0.0, 0.05, 1.2])
def test_without_wires_and_shear_it_is_a_curved_bar_of_rubber(row_mm):
    section = ring_section(SOFT_WIRES, BAND, BAND, row_mm, FOOT_MM)
    inner, outer = 300.0, 646.8 / 2
    modulus = 8 * 5.0 * 215.0
    c, radius = section.stiffness, section.radius_mm
    assert radius == 307.0
    # ∫ dy / (1 + y/R) and ∫ y² / (1 + y/R), y = r - R
    log = np.log(outer / inner)
    assert c[0, 0] == pytest.approx(modulus * radius * log, rel=1e-9)
    second = modulus * radius * ((outer**2 - inner**2) / 2 - 2 * radius * (outer - inner))
    second += modulus * radius**3 * log
    assert c[1, 1] + 2 * c[1, 2] + c[2, 2] == pytest.approx(second, rel=1e-9)


def test_wires_carry_the_section_s_bending():
    tyre = TyreGeometry()
    section = ring_section(tyre, BAND, BAND, 0.05, FOOT_MM)
    wires = tyre.wire_modulus_mpa * np.pi / 4 * 215.0 / 2.0 * 2.0
    assert section.stiffness[1, 1] == pytest.approx(2 * wires * 6.25**2, rel=0.01)
    assert section.stiffness[5, 5] == pytest.approx(2 * 5.0 * 215.0 * 12.5, rel=0.005)


def test_hardening_is_the_third_derivative_of_neo_hooke():
    section = ring_section(SOFT_WIRES, BAND, BAND, 0.0, FOOT_MM)
    # W = C10 (λ² + 1/λ² - 2) has the third derivative -24 C10 at rest; J ε = e
    log = 0.5 * (1 / 300.0 - 2 / 646.8) * 2 * section.radius_mm**2
    assert section.hardening[0, 0, 0] == pytest.approx(-24 * 5.0 * 215.0 * log, rel=1e-9)


def test_a_second_rubber_for_the_tread_changes_the_tread_only():
    both = ring_section(TyreGeometry(), BAND, Rubber(2.0, np.inf), 0.05, FOOT_MM)
    same = ring_section(TyreGeometry(), BAND, BAND, 0.05, FOOT_MM)
    assert both.stiffness[5, 5] == pytest.approx(same.stiffness[5, 5], rel=1e-12)
    assert 0.3 < both.stiffness[6, 6] / same.stiffness[6, 6] < 0.6


@pytest.mark.parametrize(
    ("tyre", "row_mm", "word"),
    [
        (TyreGeometry(), 12.6, "fill"),
        (TyreGeometry(shear_band_thickness_mm=12.9), 0.05, "cover"),
        (TyreGeometry(outer_diameter_mm=627.5), 0.05, "tread"),
    ],
)
def test_dimensions_that_contradict_each_other_are_refused(tyre, row_mm, word):
    with pytest.raises(ValueError, match=word):
        ring_section(tyre, BAND, BAND, row_mm, FOOT_MM)
