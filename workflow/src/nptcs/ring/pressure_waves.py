"""Deflection of the ring's layers under waves of pressure and shear, and the tread matched to it.

Under a pressure cos(qx) on its surface, a flat strip of rubber layers and wires settles by a
closed form of plane elasticity. A ring that thins only where the pressure acts settles too much
where the pressure varies over lengths like the tread's depth: the rubber next to a short contact
carries part of it, because a tread whose thickness varies along it is sheared. To first order this
reduces the thickening of the tread by a shift s of the surface: 1 - G/2λ of it is left (λ: Lamé's
constant), less for shorter waves. The coefficient of this thickening is therefore chosen so that
the ring settles as the layers do, under half waves from six depths down to 0.7 of one.

Under a shear sin(qx) of the ground the tread's surface moves along the ring. The shape f of the
ring's shear has no strain at the surface, although a shear of the ground requires one: the ring
moves too little, by surface/4G if the wave is long and by half of that if it is as short as the
tread is deep. A compliance in series with the ground's, the mean over the same waves, corrects it.

A layer's state is (U, V, T, S): displacement along (sin qx) and outwards (cos qx), shear stress
(sin qx) and stress across (cos qx), MPa. With the moduli of `Rubber`,

    U' = q V + T/G,  V' = S/M - ν' q U,  T' = E q² U + ν' q S,  S' = -q T.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from nptcs.arrays import Array
from nptcs.ring.rubber import Rubber

STATES = 4
# half waves, as multiples of the depth from the inner wires to the surface
HALF_WAVES = np.geomspace(0.7, 6.0, 9)
# of a foot's pull: longest half wave in the same depths, and q w of the shortest
LONGEST_HALF_WAVE, SHORTEST_WAVE, FOOT_WAVES = 12.0, 60.0, 96
# Gauss–Newton steps for a smooth function of one variable
ITERATIONS = 6


@dataclass(frozen=True)
class RubberLayer:
    """A layer of rubber, depth in mm."""

    rubber: Rubber
    depth_mm: float

    def transfer(self, wave: Array) -> Array:
        """Matrices (waves, 4, 4) from the state at its inner face to that at its outer face.

        With A the matrix of the equations above, (A² - q²)² = 0: the exponential is a cubic in A.
        """
        rubber, depth = self.rubber, self.depth_mm
        a = np.zeros((len(wave), STATES, STATES))
        a[:, 0, 1], a[:, 0, 2] = wave, 1.0 / rubber.shear_mpa
        a[:, 1, 0], a[:, 1, 3] = -rubber.contraction * wave, rubber.through_compliance_per_mpa
        a[:, 2, 0], a[:, 2, 3] = rubber.along_mpa * wave**2, rubber.contraction * wave
        a[:, 3, 2] = -wave
        q = wave[:, None, None]
        one = np.eye(STATES)
        rest = a @ a - q**2 * one
        cosh, sinh = np.cosh(q * depth), np.sinh(q * depth)
        even = cosh * one + depth * sinh / (2.0 * q) * rest
        odd = sinh / q * one + (q * depth * cosh - sinh) / (2.0 * q**3) * rest
        found: Array = even + a @ odd
        return found


@dataclass(frozen=True)
class WireSheet:
    """Wires in a row that turns with them: stiffness by width in stretch (N/mm) and bending (N mm).

    Half of the row's depth is on either side of the wires.
    """

    stretch_n_per_mm: float
    bending_n_mm: float
    depth_mm: float

    def transfer(self, wave: Array) -> Array:
        """Matrices (waves, 4, 4) from the state at its inner face to that at its outer face."""
        turned = np.tile(np.eye(STATES), (len(wave), 1, 1))
        turned[:, 0, 1] = 0.5 * self.depth_mm * wave
        turned[:, 3, 2] = -0.5 * self.depth_mm * wave
        held = np.tile(np.eye(STATES), (len(wave), 1, 1))
        held[:, 2, 0] = self.stretch_n_per_mm * wave**2
        held[:, 3, 1] = self.bending_n_mm * wave**4
        found: Array = turned @ held @ turned
        return found


def settlement(layers: Sequence[RubberLayer | WireSheet], wave: Array) -> Array:
    """Settlement (waves,) of the outer surface under a pressure cos(qx), mm per MPa.

    Parameters
    ----------
    layers : sequence
        From the inside to the outside; the inner face is free.
    wave : array (waves,)
        q, 1/mm.
    """
    found: Array = -_surface(layers, wave, [0.0, -1.0])[:, 1]
    return found


def drift(layers: Sequence[RubberLayer | WireSheet], wave: Array) -> Array:
    """Displacement (waves,) of the outer surface along itself under a shear sin(qx), mm per MPa.

    Parameters
    ----------
    layers, wave
        As in `settlement`.
    """
    found: Array = _surface(layers, wave, [1.0, 0.0])[:, 0]
    return found


def _surface(
    layers: Sequence[RubberLayer | WireSheet], wave: Array, stress: Sequence[float]
) -> Array:
    """(U, V) of the outer surface (waves, 2) under the stresses (T, S) there."""
    whole = np.tile(np.eye(STATES), (len(wave), 1, 1))
    for layer in layers:
        whole = layer.transfer(wave) @ whole
    given = np.tile(np.asarray(stress)[:, None], (len(wave), 1, 1))
    inner = np.linalg.solve(whole[:, 2:, :2], given)
    found: Array = (whole[:, :2, :2] @ inner)[:, :, 0]
    return found


@dataclass(frozen=True)
class FlatRing:
    """The ring's section without curvature; names as in `RingSection`."""

    stiffness: Array
    thickening: Array
    compliance_mm_per_mpa: float
    width_mm: float
    half_distance_mm: float
    surface_mm: float

    def settlement(self, wave: Array) -> tuple[Array, Array, Array]:
        """Settlement of the surface under a pressure cos(qx), a quadratic in its thickening by s'.

        With the thickening changed by d (mm) it is a + b d + c d², mm per MPa.

        Parameters
        ----------
        wave : array (waves,)
            q, 1/mm.

        Returns
        -------
        a, b, c : arrays (waves,)
        """
        # derivative of the surface's place by the amplitudes, and by these and the thickening
        lift = np.zeros((len(wave), 5, 2))
        lift[:, 0, 0] = 1.0
        lift[:, [2, 1, 3], 0] = self.thickening * wave[:, None]
        lift[:, 3, 1] = wave
        both = self.width_mm * lift.swapaxes(1, 2) @ np.linalg.solve(self._stiffness(wave), lift)
        return both[:, 0, 0] + self.compliance_mm_per_mpa, 2.0 * both[:, 0, 1], both[:, 1, 1]

    def inner_settlement(self, wave: Array) -> Array:
        """Displacement (waves,) of the ring under a pull cos(qx) on it, mm per MPa.

        The ring's core keeps its thickness: its inner face moves as its middle does.
        """
        lift = np.zeros((len(wave), 5, 1))
        lift[:, 0, 0] = 1.0
        solved = np.linalg.solve(self._stiffness(wave), lift)[:, 0, 0]
        return np.asarray(self.width_mm * solved, dtype=float)

    def drift(self, wave: Array) -> Array:
        """Displacement (waves,) of the surface along itself under a shear sin(qx), mm per MPa.

        To first order it is u + s - c θ - surface ψ, u the displacement along the ring.
        """
        lift = np.zeros((len(wave), 5, 1))
        lift[:, 1:, 0] = -self.surface_mm, -self.half_distance_mm, 1.0, 1.0
        solved = np.linalg.solve(self._stiffness(wave), lift)
        found: Array = self.width_mm * (lift.swapaxes(1, 2) @ solved)[:, 0, 0]
        return found

    def _stiffness(self, wave: Array) -> Array:
        """Stiffness (waves, 5, 5) of the amplitudes of a wave.

        Displacement outwards (cos), ψ, θ, s and displacement along (sin).
        """
        by = np.zeros((len(wave), 7, 5))
        by[:, 0, 4] = by[:, 1, 2] = by[:, 2, 1] = by[:, 3, 3] = wave
        by[:, 4, 0], by[:, 4, 1] = -wave, -1.0
        by[:, 5, 0], by[:, 5, 2] = -wave, -1.0
        by[:, 6, 3] = 1.0
        found: Array = by.swapaxes(1, 2) @ self.stiffness @ by
        return found


def missing_drift(
    ring: FlatRing, layers: Sequence[RubberLayer | WireSheet], depth_mm: float
) -> float:
    """Mean over `HALF_WAVES` of the excess of the layers' drift over the ring's, mm per MPa.

    Parameters
    ----------
    ring, layers, depth_mm
        As in `matched_thickening`.
    """
    wave = np.pi / (HALF_WAVES * depth_mm)
    return float(np.mean(drift(layers, wave) - ring.drift(wave)))


def foot_squeeze(
    ring: FlatRing, layers: Sequence[RubberLayer | WireSheet], depth_mm: float, width_mm: float
) -> Array:
    """Find how much further the layers give way under a foot than the ring does.

    The force F of a foot of width w is distributed evenly over it, its moment M linearly; its
    motion is the mean over w, and the rotation ∫ x u dx / ∫ x² dx. Over all waves of the pull, with
    the axial width b,

        u/F = 1/(π b) ∫ (sin X/X)² c dq,  φ/M = 1/(π b) ∫ (3 q (sin X - X cos X)/X³)² c dq,

    X = q w/2, with c(q) the settlement of the layers' inner face less that of the ring. Waves
    longer than 24 depths, which both carry alike, are left out.

    Parameters
    ----------
    ring, layers, depth_mm
        As in `matched_thickening`.
    width_mm : float
        w.

    Returns
    -------
    array (2,)
        u/F in mm/N, φ/M in 1/(N mm).
    """
    low, high = np.pi / (LONGEST_HALF_WAVE * depth_mm), SHORTEST_WAVE / width_mm
    points, weights = np.polynomial.legendre.leggauss(FOOT_WAVES)
    wave = 0.5 * (low + high) + 0.5 * (high - low) * points
    missing = settlement(layers[::-1], wave) - ring.inner_settlement(wave)
    x = 0.5 * wave * width_mm
    even = np.sin(x) / x
    linear = 3.0 * wave * (np.sin(x) - x * np.cos(x)) / x**3
    scale = 0.5 * (high - low) * weights * missing / (np.pi * ring.width_mm)
    return np.array([scale @ even**2, scale @ linear**2])


def matched_thickening(
    ring: FlatRing, layers: Sequence[RubberLayer | WireSheet], depth_mm: float
) -> float:
    """Find the change of the thickening by s' with which the ring settles as the layers do.

    Least squares of the settlement over `HALF_WAVES`, by the Gauss–Newton method.

    Parameters
    ----------
    ring : FlatRing
    layers : sequence
        Of the same section.
    depth_mm : float
        From the inner wires to the surface.

    Returns
    -------
    float
        mm.
    """
    wave = np.pi / (HALF_WAVES * depth_mm)
    least, linear, square = ring.settlement(wave)
    missing = settlement(layers, wave) - least
    change = 0.0
    for _ in range(ITERATIONS):
        slope = linear + 2.0 * square * change
        left = missing - (linear + square * change) * change
        change += float(slope @ left / (slope @ slope))
    return change
