"""Responses of a loaded tyre, from arrays that every ring has: pressures and motions of spokes."""

from __future__ import annotations

import numpy as np

from nptcs.arrays import Array, Index
from nptcs.fe.spoke.energy_table import SpokeEnergyTable
from nptcs.fe.tyre.contact import ContactCells
from nptcs.fe.tyre.mesh import MEMBRANES, RingMesh

# fraction of the largest energy of a spoke above which a spoke's stress may be the largest
DECIDING = 0.75
# fewest parts of the tread in a contact that is resolved
LEAST_CELLS = 5.0


def contact_responses(cells: ContactCells) -> dict[str, float]:
    """Length of the contact, and its largest and mean pressure.

    The length is that of an even pressure with the same variance of place, √(12 Var). The pressure
    of each contact point is spread evenly over the part of the tread that the point represents, so
    that the length does not jump by an element when a point lifts off, and the mean pressure, the
    load per width over that length, does not exceed the largest. For a contact shorter than
    `LEAST_CELLS` such parts only their number is returned: its length would be that of the mesh.

    Parameters
    ----------
    cells : ContactCells

    Returns
    -------
    dict of str to float
        ``contact_cells`` (length of the contact over that of the longest part with a pressure)
        and, if that is `LEAST_CELLS` or more, ``contact_length_mm``, ``largest_pressure_mpa`` and
        ``mean_pressure_mpa``; empty if nothing touches.
    """
    loaded = cells.pressure_mpa > 0.0
    if not loaded.any():
        return {}
    low, high = cells.low_mm[loaded], cells.high_mm[loaded]
    share = (cells.pressure_mpa * cells.length_mm)[loaded]
    line_load = float(np.sum(share))
    middle, width = 0.5 * (low + high), high - low
    mean = float(np.sum(share * middle)) / line_load
    variance = float(np.sum(share * ((middle - mean) ** 2 + width**2 / 12.0))) / line_load
    length = float(np.sqrt(12.0 * variance))
    across = length / float(width.max())
    # a part on the ground has its loaded length, not its unloaded one
    largest = float(np.max(share / width))
    found = {"contact_cells": across}
    if across >= LEAST_CELLS:
        found |= {
            "contact_length_mm": length,
            "largest_pressure_mpa": largest,
            "mean_pressure_mpa": line_load / length,
        }
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

    The plate's largest stress is in one of them: if one spoke is above the contact it is that
    spoke, if the contact's middle is between two spokes it is either.
    """
    energy, _, _ = table.evaluate(motion)
    order: Index = np.argsort(-energy, kind="stable")
    return order[energy[order] >= DECIDING * energy.max()]


def wire_wrinkle_mm(ring: RingMesh, displacement: Array) -> float | None:
    """Amplitude of the waves, two elements long, in which membranes wrinkle, mm.

    In a compressed wire layer every other node moves out and the rest in: this is the part of the
    radial displacement that changes its sign from node to node, the largest of both layers. Waves
    much longer than an element do not count. None for wires that bend.

    Parameters
    ----------
    ring : RingMesh
    displacement : array (nodes, 2)
    """
    if ring.wire_orders != MEMBRANES:
        return None
    outward = np.stack([np.sin(ring.theta), -np.cos(ring.theta)], axis=1)
    amplitudes = []
    for nodes, place in zip(ring.wire_elements, ring.wire_places, strict=True):
        low, high = displacement[nodes[:, 0]], displacement[nodes[:, 2]]
        radial = np.sum(outward * ((1.0 - place) * low + (1.0 + place) * high) / 2.0, axis=1)
        amplitudes.append(np.abs(_alternating(_alternating(radial))).max())
    return float(max(amplitudes))


def _alternating(values: Array) -> Array:
    """Half of the difference from the mean of the two neighbours around the ring."""
    difference: Array = (values - 0.5 * (np.roll(values, 1) + np.roll(values, -1))) / 2.0
    return difference
