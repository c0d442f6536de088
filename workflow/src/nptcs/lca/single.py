"""Solve one design, or one design along its load–displacement curve."""

from __future__ import annotations

from dataclasses import asdict

import numpy as np
import pandas as pd
from numpy.typing import ArrayLike

from nptcs.errors import InputError
from nptcs.lca.batch import RESULT_COLUMNS, Batch, scaled, solve_batch
from nptcs.lca.scaling import Array
from nptcs.lca.section import RingSection
from nptcs.lca.spokes import LinearSpokes
from nptcs.lca.state import LcaState
from nptcs.lca.system import Arcs, join

REMEDIES = {
    "bad_input": "give numbers that a tyre can have",
    "beyond_model": "give a smaller load, or a stiffer ring or spokes",
    "no_convergence": "check the units of the ring's and the spokes' stiffness",
}


class ModelError(InputError):
    """A design that is well formed, but that the model cannot carry or solve."""


def design_row(section: RingSection, spokes: LinearSpokes) -> dict[str, float]:
    """Return a design as a row of `nptcs.lca.batch.DESIGN_COLUMNS`."""
    row = asdict(section) | asdict(spokes)
    row["spoke_count"] = row.pop("count")
    return row


def solve(
    section: RingSection,
    spokes: LinearSpokes,
    *,
    load_n: float | None = None,
    displacement_mm: float | None = None,
    theta_c_deg: float | None = None,
    largest_displacement_mm: float | None = None,
) -> LcaState:
    """Solve the load-bearing model (section 3.3 of the paper) for one design.

    Parameters
    ----------
    section : RingSection
        The ring.
    spokes : LinearSpokes
        The spokes.
    load_n, displacement_mm, theta_c_deg : float
        Exactly one of them.
    largest_displacement_mm : float, optional
        Displacement at which the band meets the rim; without it the radius R.

    Returns
    -------
    LcaState
        Solution; `LcaState.doubts` says which of the model's assumptions it breaks.

    Raises
    ------
    InputError
        Not exactly one target, or a target that is not above zero.
    ModelError
        The model cannot reach the target; the text gives the reason.
    """
    row = design_row(section, spokes)
    batch = solve_batch(
        row,
        load_n=load_n,
        displacement_mm=displacement_mm,
        theta_c_deg=theta_c_deg,
        largest_displacement_mm=largest_displacement_mm,
    )
    status = str(batch.status[0])
    if status in REMEDIES:
        kind = InputError if status == "bad_input" else ModelError
        raise kind(f"load-bearing model: {batch.message[0]}", remedy=REMEDIES[status])
    numbers = {column: float(batch.columns[column][0]) for column in RESULT_COLUMNS}
    ring = scaled({column: np.atleast_1d(value).astype(float) for column, value in row.items()})
    arcs = Arcs.of(ring)
    theta_c, theta_t = (
        np.atleast_1d(np.radians(numbers[column])) for column in ("theta_c_deg", "theta_t_deg")
    )
    joined = join(ring, arcs, theta_c, theta_t)
    return LcaState(
        section, spokes, **numbers, doubts=batch.message[0], _ring=ring, _arcs=arcs, _joined=joined
    )


def curve(
    section: RingSection,
    spokes: LinearSpokes,
    *,
    load_n: ArrayLike | None = None,
    displacement_mm: ArrayLike | None = None,
    largest_displacement_mm: float | None = None,
) -> pd.DataFrame:
    """Return the load–displacement curve with contact length and pressure.

    Parameters
    ----------
    section, spokes : RingSection, LinearSpokes
        The design.
    load_n, displacement_mm : array-like
        Exactly one of them: the points of the curve.
    largest_displacement_mm : float, optional
        Displacement at which the band meets the rim.

    Returns
    -------
    DataFrame
        Columns `RESULT_COLUMNS`, ``contact_length_mm``, ``status`` and ``message``, a row a point.
    """
    batch: Batch = solve_batch(
        design_row(section, spokes),
        load_n=load_n,
        displacement_mm=displacement_mm,
        largest_displacement_mm=largest_displacement_mm,
    )
    table = pd.DataFrame(batch.columns)
    angle: Array = np.radians(table["theta_c_deg"].to_numpy())
    table["contact_length_mm"] = 2 * section.radius_mm * angle
    table["status"], table["message"] = batch.status, batch.message
    return table
