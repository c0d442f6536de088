"""What a loaded tyre does, from arrays that every ring has: pressures, and motions of spokes."""

from __future__ import annotations

import numpy as np

from nptcs.arrays import Array, Index
from nptcs.fe.spoke.energy_table import SpokeEnergyTable

# part of the largest energy of a spoke above which a spoke's stress may be the largest one
DECIDING = 0.75


def contact_responses(place_mm: Array, pressure_mpa: Array, length_mm: Array) -> dict[str, float]:
    """Length of the contact, and its largest and mean pressure.

    The length is that of an even pressure with the same variance of place, √(12 Var), each point
    counting with its pressure times its length: it does not jump by an element when a point
    lifts off. The mean pressure is the load per width over that length.

    Parameters
    ----------
    place_mm, pressure_mpa, length_mm : arrays (points,)
        Place along the ground, normal pressure and length of the ring that each point stands for.

    Returns
    -------
    dict of str to float
        ``contact_length_mm``, ``largest_pressure_mpa``, ``mean_pressure_mpa``; empty if nothing
        touches.
    """
    share = pressure_mpa * length_mm
    line_load = float(np.sum(share))
    if not line_load > 0.0:
        return {}
    middle = float(np.sum(share * place_mm)) / line_load
    variance = float(np.sum(share * (place_mm - middle) ** 2)) / line_load
    found = {"largest_pressure_mpa": float(pressure_mpa.max())}
    if variance > 0.0:
        length = float(np.sqrt(12.0 * variance))
        found |= {"contact_length_mm": length, "mean_pressure_mpa": line_load / length}
    return found


def spoke_forces(table: SpokeEnergyTable, motion: Array) -> dict[str, float]:
    """Largest and smallest radial force of the spokes on the band's feet.

    Parameters
    ----------
    table : SpokeEnergyTable
    motion : array (spokes, 3)
        (u_r, u_θ, φ) of each foot.

    Returns
    -------
    dict of str to float
        Positive in tension; the smallest is the compression of the spoke over the contact.
    """
    _, force, _ = table.evaluate(motion)
    return {
        "largest_spoke_force_n": float(force[:, 0].max()),
        "smallest_spoke_force_n": float(force[:, 0].min()),
    }


def deciding_spokes(table: SpokeEnergyTable, motion: Array) -> Index:
    """Numbers of the spokes that store nearly as much energy as the one that stores most.

    The plate's largest stress is in one of them: where one spoke stands over the contact it is
    that spoke, where the contact's middle is between two spokes it is either.
    """
    energy, _, _ = table.evaluate(motion)
    order: Index = np.argsort(-energy, kind="stable")
    return order[energy[order] >= DECIDING * energy.max()]
