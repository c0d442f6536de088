"""The single spoke pulled and compressed, section 4.3.1 of the paper (figure 13, table 10)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from threadpoolctl import threadpool_limits

from nptcs.arrays import Array
from nptcs.fe.spoke.equilibrium import SpokeModel, SpokeState
from nptcs.fe.spoke.stiffness_line import StiffnessLine, stiffness_line

TENSION_MM = 4.0
COMPRESSION_MM = 20.0


def walk(model: SpokeModel, end_mm: float, steps: int) -> list[SpokeState]:
    """Equilibria from rest to a radial displacement of the band, which is held from turning."""
    motions = np.zeros((steps, 3))
    motions[:, 0] = np.linspace(0.0, end_mm, steps + 1)[1:]
    rest = model.rest()
    return [rest, *model.walk(rest, motions)]


def pull(model: SpokeModel, end_mm: float, steps: int) -> tuple[Array, Array]:
    """Force (N) on the band against its radial displacement (mm), the band held from turning.

    Parameters
    ----------
    model : SpokeModel
    end_mm : float
        Last u_r, positive in tension.
    steps : int

    Returns
    -------
    displacement_mm, force_n : arrays (steps + 1,)
        Both in the direction of the motion, the unloaded spoke first.
    """
    states = walk(model, end_mm, steps)
    sign = np.sign(end_mm)
    return (
        sign * np.array([state.motion[0] for state in states]),
        sign * np.array([state.force[0] for state in states]),
    )


@dataclass(frozen=True)
class SpokeStiffness:
    """Tension and compression of one spoke: figure 13's curves and table 10's lines."""

    tension: tuple[Array, Array]
    compression: tuple[Array, Array]
    tension_fit: StiffnessLine
    compression_fit: StiffnessLine


@threadpool_limits.wrap(limits=1)
def spoke_stiffness(
    model: SpokeModel, tension_steps: int = 8, compression_steps: int = 10
) -> SpokeStiffness:
    """Pull a spoke by 4 mm, compress it by 20 mm, and fit lines through the origin."""
    tension = pull(model, TENSION_MM, tension_steps)
    compression = pull(model, -COMPRESSION_MM, compression_steps)
    return SpokeStiffness(
        tension, compression, stiffness_line(*tension), stiffness_line(*compression)
    )
