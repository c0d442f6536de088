"""The band in pure bending against plane elasticity of its layers, and what the core gives."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from nptcs.config.solvers.tyre import TyreGeometry
from nptcs.ring.kernel.elementwise import band
from nptcs.ring.rubber import Rubber
from nptcs.ring.section import ring_section

TYRE = TyreGeometry()
BAND, TREAD = Rubber(4.0, 10.0), Rubber(3.0, 10.0)
FOOT_MM = 16.0


def wires_n(tyre):
    one = np.pi / 4 * tyre.wire_diameter_mm**2
    return (
        one
        * tyre.wire_modulus_mpa
        * tyre.tread_width_mm
        / tyre.wire_pitch_mm
        * tyre.wire_layers
        / 2
    )


def bending_of_layers(band, tread):
    """Bending stiffness M R/α: all sections turn by α per radian, u_θ = α r θ and u_r = f(r).

    σ_r' = (σ_θ - σ_r)/r between the free faces; the wires are membranes, across which σ_r jumps by
    their force by width and radius.
    """
    inner, outer = TYRE.inner_wire_diameter_mm / 2, TYRE.outer_wire_diameter_mm / 2
    cover = 0.5 * (TYRE.shear_band_thickness_mm - (outer - inner))
    face = TYRE.outer_diameter_mm / 2
    spans = [
        (inner - cover, inner, band),
        (inner, outer, band),
        (outer, outer + cover, band),
        (outer + cover, face, tread),
    ]
    membrane = wires_n(TYRE) / TYRE.tread_width_mm

    def through(start, alpha):
        """σ_r at the surface, and the moment by width, for f at the inner face."""
        f, stress, moment = start, 0.0, 0.0
        for low, high, rubber in spans:
            shear = rubber.shear_mpa
            bulk = shear * rubber.bulk_to_shear_ratio
            along, across = bulk + 4 * shear / 3, bulk - 2 * shear / 3

            def slopes(r, y, along=along, across=across):
                hoop = y[0] / r + alpha
                radial = (y[1] - across * hoop) / along
                tension = along * hoop + across * radial
                return [radial, (tension - y[1]) / r, tension * r]

            end = solve_ivp(slopes, (low, high), [f, stress, moment], rtol=1e-10, atol=1e-12)
            f, stress, moment = end.y[:, -1]
            if high in (inner, outer):
                force = membrane * (f / high + alpha)
                stress, moment = stress + force / high, moment + force * high
        return np.array([stress, moment])

    by_f, by_alpha = through(1.0, 0.0), through(0.0, 1.0)
    start = -by_alpha[0] / by_f[0]
    radius = 0.5 * (inner + outer)
    own = 2 * wires_n(TYRE) * TYRE.wire_diameter_mm**2 / 16
    return TYRE.tread_width_mm * (by_alpha[1] + start * by_f[1]) * radius + own


def bending_of_ring(section, gives):
    """Stiffness by κs = κf without a force along the ring, near the unloaded state."""
    c = section.stiffness[:3, :3].copy()
    if gives:
        pull, soft, held, turn = section.core[:3], *section.core[3:]
        c -= soft * turn**2 / (1 + soft * held * turn**2) * np.outer(pull, pull)
    both = np.array([[1.0, 0.0], [0.0, 1.0], [0.0, 1.0]])
    small = both.T @ c @ both
    return small[1, 1] - small[0, 1] ** 2 / small[0, 0]


@pytest.mark.parametrize(("band", "tread"), [(BAND, TREAD), (Rubber(4.0, 3.0), TREAD)])
def test_the_band_bends_as_its_layers_do(band, tread):
    section = ring_section(TYRE, band, tread, 0.0, FOOT_MM)
    exact = bending_of_layers(band, tread)
    assert bending_of_ring(section, True) == pytest.approx(exact, rel=0.003)
    # a core that keeps its thickness is several per cent too stiff
    assert bending_of_ring(section, False) > 1.03 * exact


def test_incompressible_rubber_keeps_the_thickness():
    hard = Rubber(4.0, np.inf)
    section = ring_section(TYRE, hard, hard, 0.0, FOOT_MM)
    assert section.core[3] == 0.0
    nearly = Rubber(4.0, 1e4)
    assert bending_of_ring(section, True) == pytest.approx(bending_of_layers(nearly, nearly), 0.003)


def test_energy_and_its_derivatives():
    section = ring_section(TYRE, BAND, TREAD, 0.05, FOOT_MM)
    e, d = 2e-4, np.array([0.0, 0.0, 3e-4, 1e-3, 0.0])
    stress, stiff = np.zeros(4), np.zeros((4, 4))
    band.add_core_give(section.core, e, d, stress, stiff)

    def energy(v):
        own = np.array([0.0, 0.0, v[1], v[2], 0.0])
        pull, give, _, _ = band.core_give(section.core, v[0], own)
        return -0.5 * give * pull**2

    def least(v):
        """Least energy of wires and core over the faces' motion δ, less that of a hard core."""
        pull = section.core[:3] @ v
        soft, held, turn = section.core[3:]
        delta = np.linspace(-0.05, 0.05, 200001)
        chi = turn - v[2]
        return np.min(chi * delta * pull + 0.5 * (held * chi**2 + 1 / soft) * delta**2)

    v = np.array([e, d[2], d[3]])
    assert energy(v) == pytest.approx(least(v), rel=1e-4)
    steps = np.array([1e-7, 1e-8, 1e-7])
    slopes = [
        (energy(v + h) - energy(v - h)) / 2 / s for h, s in zip(np.diag(steps), steps, strict=True)
    ]
    np.testing.assert_allclose(stress[:3], slopes, rtol=1e-6)
    # on a straight wire nothing presses
    flat = np.array([0.0, 0.0, 3e-4, section.core[5], 0.0])
    assert band.core_give(section.core, e, flat)[1] == 0.0
