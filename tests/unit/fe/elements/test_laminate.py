import numpy as np
import pytest

from nptcs.laminate import abd, reduced_stiffness, rotated_stiffness, transverse_shear


def test_reduced_stiffness_inverts_the_ply_compliance(ply):
    compliance = np.linalg.inv(reduced_stiffness(ply))
    assert 1.0 / compliance[0, 0] == pytest.approx(ply["e1_mpa"])
    assert -compliance[1, 0] / compliance[0, 0] == pytest.approx(ply["nu12"])
    assert 1.0 / compliance[2, 2] == pytest.approx(ply["g12_mpa"])


def test_a_quarter_turn_swaps_the_axes(ply):
    q, turned = reduced_stiffness(ply), rotated_stiffness(ply, 90.0)
    assert turned[0, 0] == pytest.approx(q[1, 1])
    assert turned[1, 1] == pytest.approx(q[0, 0])
    assert transverse_shear(ply, 90.0) == pytest.approx(np.diag([2300.0, 3147.0]))


def test_the_angle_of_an_isotropic_ply_does_not_matter(ply):
    ply.update(e1_mpa=2600.0, e2_mpa=2600.0, nu12=0.3, g12_mpa=1000.0)
    assert rotated_stiffness(ply, 33.0) == pytest.approx(reduced_stiffness(ply))


def test_antisymmetric_angle_plies_couple_bending_to_shear_only(ply):
    stiffness = abd(ply, 45.0, 1.8)
    coupling = stiffness[:3, 3:]
    assert np.abs(coupling[:2, :2]).max() < 1e-9 * np.abs(coupling).max()
    assert abs(coupling[2, 2]) < 1e-9 * np.abs(coupling).max()
    # B16 of two plies: Q̄16 (t²/4) / 2 each, of opposite sign
    assert coupling[0, 2] == pytest.approx(-rotated_stiffness(ply, 45.0)[0, 2] * 1.8**2 / 4.0)
    assert abd(ply, 0.0, 1.8)[:3, 3:] == pytest.approx(np.zeros((3, 3)))
    assert abd(ply, 0.0, 2.0)[3, 3] == pytest.approx(reduced_stiffness(ply)[0, 0] * 8.0 / 12.0)


def test_a_strip_that_may_bow_is_softest_near_60_degrees_and_one_that_may_not_at_90(published_ply):
    """Bending moduli of [+A/-A] with free edges, without κ22, and held in all but bending."""
    moduli = []
    for kept in ([0, 1, 2, 3, 4, 5], [0, 1, 2, 3, 5], [3]):
        place = kept.index(3)
        for angle in (60.0, 75.0, 90.0):
            compliance = np.linalg.inv(abd(published_ply, angle, 1.8)[np.ix_(kept, kept)])
            moduli.append(12.0 / 1.8**3 / compliance[place, place])
    assert moduli[:3] == pytest.approx([8138.0, 8470.0, 8800.0], abs=1.0)
    assert moduli[3:6] == pytest.approx([11526.0, 9166.0, 8878.0], abs=1.0)
    assert moduli[6:] == pytest.approx([16613.0, 9491.0, 8878.0], abs=1.0)


def test_many_plates_at_once_are_the_plates_one_by_one(ply):
    angles, thicknesses = np.array([0.0, 17.0, 45.0, 90.0]), np.array([1.2, 1.8, 2.4, 0.7])
    together = abd(ply, angles, thicknesses)
    for number, (angle, thickness) in enumerate(zip(angles, thicknesses, strict=True)):
        alone = abd(ply, angle, thickness)
        np.testing.assert_allclose(together[number], alone, atol=1e-9 * np.abs(alone).max())
