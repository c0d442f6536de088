"""The deformed ring with its regions and the contact pressure, as one figure."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from nptcs.lca.neutral_line import neutral_line
from nptcs.lca.state import LcaState

COLOURS = {"contact": "#d55e00", "compression": "#0072b2", "tension": "#009e73"}
"""One colour per region, distinguishable for colour-blind readers too."""


def ring_figure(state: LcaState) -> Figure:
    """Draw the ring at true scale and the pressure over the contact length.

    Parameters
    ----------
    state : LcaState
        A solved design.
    """
    figure = Figure(figsize=(9.0, 4.6), layout="constrained")
    left, right = figure.subplots(1, 2, width_ratios=(1.2, 1.0))
    _draw_ring(left, state)
    _draw_pressure(right, state)
    figure.suptitle(
        f"F = {state.load_n:.0f} N, δ = {state.displacement_mm:.2f} mm, "
        f"K = {state.stiffness_n_per_mm:.1f} N/mm"
    )
    return figure


def _draw_ring(axes: Axes, state: LcaState) -> None:
    """Draw the middle line before and after, in the colours of its regions."""
    line = neutral_line(state, 1441)
    axes.plot(line["x_undeformed_mm"], line["y_undeformed_mm"], "--", color="0.6", label="unloaded")
    names = {
        "contact": "contact",
        "compression": f"compression, to θt = {state.theta_t_deg:.1f}°",
        "tension": "tension",
    }
    for region, label in names.items():
        part = line.where(line["region"] == region)
        axes.plot(part["x_mm"], part["y_mm"], color=COLOURS[region], linewidth=2.5, label=label)
    axes.plot(0, 0, "k+")
    axes.set(aspect="equal", xlabel="x in mm, hub at 0", ylabel="y in mm")
    axes.legend(loc="upper center", bbox_to_anchor=(0.5, 0.85), fontsize="small", frameon=False)


def _draw_pressure(axes: Axes, state: LcaState) -> None:
    """Draw the pressure of ring and spokes over the contact."""
    edge = state.theta_c_deg * (1 - 1e-9)
    angles = np.linspace(-edge, edge, 201)
    contact = state.at(angles)
    along = np.radians(angles) * state.section.radius_mm
    ring = contact["pressure_mpa"].to_numpy()
    total = ring + contact["spoke_pressure_mpa"].to_numpy()
    axes.fill_between(along, 0, ring, color="0.85", label="by the ring")
    axes.fill_between(
        along, ring, total, color=COLOURS["contact"], alpha=0.6, label="by the spokes"
    )
    axes.set(
        xlabel=f"along the band in mm (contact length {state.contact_length_mm:.1f} mm)",
        ylabel="contact pressure in MPa",
    )
    axes.set_ylim(min(0.0, float(total.min())), None)
    axes.legend(loc="lower center", fontsize="small")
