"""How the layers of the ring settle under waves of pressure, and the ring's tread matched to it.

Under a pressure cos(qx) on its surface, a flat strip of rubber layers and wires settles by a
closed form of plane elasticity. A ring that thins under the pressure right below each place
settles too much where the pressure varies over lengths like the tread's depth: the rubber next to
a short contact carries part of it, because a tread whose thickness varies along it is sheared.
To the first order this takes from what a shift s of the surface thickens the tread: 1 - G/2λ
of it is left (λ of Lamé), less for shorter waves. The coefficient of this thickening is
therefore chosen so that the ring settles as the layers do, under waves from six depths down to
two thirds of one.

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
# half waves by the depth from the inner wires to the surface
HALF_WAVES = np.geomspace(0.7, 6.0, 9)
# of a smooth function of one number
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

    The row's depth is half on either side of the wires.
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
    whole = np.tile(np.eye(STATES), (len(wave), 1, 1))
    for layer in layers:
        whole = layer.transfer(wave) @ whole
    pressed = np.zeros((len(wave), 2, 1))
    pressed[:, 1] = -1.0
    inner = np.linalg.solve(whole[:, 2:, :2], pressed)
    found: Array = -(whole[:, 1:2, :2] @ inner)[:, 0, 0]
    return found


@dataclass(frozen=True)
class FlatRing:
    """The ring's section without curvature, as `RingSection` has it."""

    stiffness: Array
    thickening: Array
    compliance_mm_per_mpa: float
    width_mm: float

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
        # amplitudes: displacement outwards (cos), ψ, θ, s and displacement along (sin)
        by = np.zeros((len(wave), 7, 5))
        by[:, 0, 4] = by[:, 1, 2] = by[:, 2, 1] = by[:, 3, 3] = wave
        by[:, 4, 0], by[:, 4, 1] = -wave, -1.0
        by[:, 5, 0], by[:, 5, 2] = -wave, -1.0
        by[:, 6, 3] = 1.0
        stiff = by.swapaxes(1, 2) @ self.stiffness @ by
        # the surface's place by the amplitudes, and by them times a change of the thickening
        lift = np.zeros((len(wave), 5, 2))
        lift[:, 0, 0] = 1.0
        lift[:, [2, 1, 3], 0] = self.thickening * wave[:, None]
        lift[:, 3, 1] = wave
        both = self.width_mm * lift.swapaxes(1, 2) @ np.linalg.solve(stiff, lift)
        return both[:, 0, 0] + self.compliance_mm_per_mpa, 2.0 * both[:, 0, 1], both[:, 1, 1]


def matched_thickening(
    ring: FlatRing, layers: Sequence[RubberLayer | WireSheet], depth_mm: float
) -> float:
    """Find the change of the thickening by s' with which the ring settles as the layers do.

    Least squares of the settlement over `HALF_WAVES`, by Gauss and Newton.

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
