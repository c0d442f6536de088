"""What a designer asks of a loaded ring."""

from __future__ import annotations

import numpy as np

from nptcs.arrays import Array
from nptcs.ring.solution import RingState, tangent_stiffness
from nptcs.ring.tyre import RingTyre


def contact_length_mm(place_mm: Array, force_n: Array) -> float:
    """Length of the uniform pressure with the same variance of place: √(12 Var p).

    Parameters
    ----------
    place_mm : array (n,)
    force_n : array (n,)
        Vertical force at each place. Without any the length is 0.
    """
    total = float(np.sum(force_n))
    if total <= 0.0:
        return 0.0
    middle = float(np.sum(force_n * place_mm)) / total
    return float(np.sqrt(12.0 * np.sum(force_n * (place_mm - middle) ** 2) / total))


def responses(tyre: RingTyre, state: RingState) -> dict[str, float]:
    """Contact patch, spokes' motions and energies at a state, units in the names."""
    place, pressure, _ = tyre.traction(state.u, state.rise_mm, state.anchor_before)
    motion = tyre.spoke_motion(state.u)
    energy = tyre.energy(state.u)
    return {
        "tangent_stiffness_n_per_mm": tangent_stiffness(tyre, state),
        "contact_length_mm": contact_length_mm(place, pressure * tyre.areas_mm2()),
        "largest_pressure_mpa": float(pressure.max()),
        "smallest_u_r_mm": float(motion[:, 0].min()),
        "largest_u_r_mm": float(motion[:, 0].max()),
        "spoke_energy_n_mm": energy["spokes"],
        "band_energy_n_mm": energy["band"],
    }
