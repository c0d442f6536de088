"""The deformed neutral line of the band, as in figure 14 of the paper."""

from __future__ import annotations

import numpy as np
import pandas as pd

from nptcs.lca.state import LcaState


def neutral_line(state: LcaState, points: int = 721) -> pd.DataFrame:
    """Return the deformed middle line of the band, as in figure 14.

    Parameters
    ----------
    state : LcaState
        A solved design.
    points : int
        Points around the whole ring.

    Returns
    -------
    DataFrame
        ``theta_deg``, ``region``, ``x_mm``, ``y_mm`` (deformed, the hub at the origin, y up) and
        ``x_undeformed_mm``, ``y_undeformed_mm``.
    """
    line = state.at(np.linspace(-180.0, 180.0, points))
    angle = np.radians(line["theta_deg"].to_numpy())
    radius = state.section.radius_mm
    radial = radius + line["u_r_mm"].to_numpy()
    along = line["u_theta_mm"].to_numpy()
    line["x_mm"] = radial * np.sin(angle) + along * np.cos(angle)
    line["y_mm"] = -radial * np.cos(angle) + along * np.sin(angle)
    line["x_undeformed_mm"] = radius * np.sin(angle)
    line["y_undeformed_mm"] = -radius * np.cos(angle)
    return line[["theta_deg", "region", "x_mm", "y_mm", "x_undeformed_mm", "y_undeformed_mm"]]
