"""Solve one design, or one design along its load–displacement curve."""

from __future__ import annotations

from dataclasses import asdict

import numpy as np
import pandas as pd
from numpy.typing import ArrayLike

from nptcs.arrays import Floating
from nptcs.errors import InputError
from nptcs.lca.batch import (
    RESULT_COLUMNS,
    Batch,
    bad_rows,
    columns,
    only_target,
    solve_batch,
    solve_rows,
)
from nptcs.lca.section import ShearBandSection
from nptcs.lca.spokes.linear import LinearSpokes
from nptcs.lca.state import LcaState

REMEDIES = {
    "beyond_model": "give a smaller load, or a stiffer ring or spokes",
    "no_convergence": "check the units of the ring's and the spokes' stiffness",
}


class ModelError(InputError):
    """A design that is well formed but that the model cannot solve."""


def design_row(section: ShearBandSection, spokes: LinearSpokes) -> dict[str, float]:
    """Return a design as a row of `nptcs.lca.batch.DESIGN_COLUMNS`."""
    row = asdict(section) | asdict(spokes)
    row["spoke_count"] = row.pop("count")
    return row


def solve(
    section: ShearBandSection,
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
    section : ShearBandSection
        The ring.
    spokes : LinearSpokes
        The spokes.
    load_n, displacement_mm, theta_c_deg : float
        Exactly one of them.
    largest_displacement_mm : float, optional
        Displacement at which the band meets the rim; by default the radius R.

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

    Examples
    --------
    Table 11 of the paper, S-C 1 at 5000 N (printed: 20.87 mm, 4.585° and 56.198°):

    >>> from nptcs.config.solvers.tyre import TyreGeometry
    >>> ring = ShearBandSection.from_tyre(TyreGeometry(), c10_mpa=5.0)
    >>> state = solve(ring, LinearSpokes(30.2, 13.26), load_n=5000)
    >>> round(state.displacement_mm, 2), round(state.theta_c_deg, 3), round(state.theta_t_deg, 2)
    (20.74, 4.569, 56.45)
    """
    name, value = only_target(load_n, displacement_mm, theta_c_deg)
    table = columns(design_row(section, spokes), value, largest_displacement_mm)
    if bad := bad_rows(table, name)[0]:
        raise InputError(
            f"load-bearing model: {bad}", remedy="give values that are possible for a tyre"
        )
    (piece,) = solve_rows(table, name)
    if (status := str(piece.status[0])) in REMEDIES:
        raise ModelError(f"load-bearing model: {piece.message[0]}", remedy=REMEDIES[status])
    return LcaState(
        section,
        spokes,
        **{column: float(piece.numbers[column][0]) for column in RESULT_COLUMNS},
        doubts=piece.message[0],
        _ring=piece.ring,
        _arcs=piece.arcs,
        _joined=piece.joined,
    )


def curve(
    section: ShearBandSection,
    spokes: LinearSpokes,
    *,
    load_n: ArrayLike | None = None,
    displacement_mm: ArrayLike | None = None,
    largest_displacement_mm: float | None = None,
) -> pd.DataFrame:
    """Return the load–displacement curve with contact length and pressure.

    Parameters
    ----------
    section, spokes : ShearBandSection, LinearSpokes
        The design.
    load_n, displacement_mm : array-like
        Exactly one of them: the points of the curve.
    largest_displacement_mm : float, optional
        Displacement at which the band meets the rim.

    Returns
    -------
    DataFrame
        Columns `RESULT_COLUMNS`, ``contact_length_mm``, ``status`` and ``message``; one row per
        point.

    Examples
    --------
    >>> from nptcs.config.solvers.tyre import TyreGeometry
    >>> ring = ShearBandSection.from_tyre(TyreGeometry(), c10_mpa=5.0)
    >>> points = curve(ring, LinearSpokes(30.2, 13.26), load_n=[2500, 5000])
    >>> points["displacement_mm"].round(2).tolist()
    [10.62, 20.74]
    """
    batch: Batch = solve_batch(
        design_row(section, spokes),
        load_n=load_n,
        displacement_mm=displacement_mm,
        largest_displacement_mm=largest_displacement_mm,
    )
    table = pd.DataFrame(batch.columns)
    angle: Floating = np.radians(table["theta_c_deg"].to_numpy())
    table["contact_length_mm"] = 2 * section.radius_mm * angle
    table["status"], table["message"] = batch.status, batch.message
    return table
