"""Responses of a loaded ring that a designer needs."""

from __future__ import annotations

from nptcs.fe.tyre.contact import ContactCells
from nptcs.fe.tyre.responses import contact_responses
from nptcs.ring.solution import RingState, tangent_stiffness
from nptcs.ring.tyre import RingTyre


def contact_cells(tyre: RingTyre, state: RingState) -> ContactCells:
    """Parts of the tread over each element, with the pressure at its middle."""
    place, pressure, _ = tyre.traction(state.u, state.rise_mm, state.anchor_before)
    length = tyre.areas_mm2() / tyre.section.width_mm
    return ContactCells(place - 0.5 * length, place + 0.5 * length, pressure, length)


def responses(tyre: RingTyre, state: RingState) -> dict[str, float]:
    """Contact patch, spokes' motions and energies at a state, units in the names.

    A contact of too few elements has neither length nor pressures, as in `fe_tyre`.
    """
    motion = tyre.spoke_motion(state.u)
    energy = tyre.energy(state.u)
    return {
        "tangent_stiffness_n_per_mm": tangent_stiffness(tyre, state),
        **contact_responses(contact_cells(tyre, state)),
        "smallest_u_r_mm": float(motion[:, 0].min()),
        "largest_u_r_mm": float(motion[:, 0].max()),
        "spoke_energy_n_mm": energy["spokes"],
        "band_energy_n_mm": energy["band"],
    }
