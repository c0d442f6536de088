"""Fit a surrogate to the spokes of a study."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import numpy as np
import pandas as pd

from nptcs.config.solvers.fe import FeModel
from nptcs.config.solvers.ring import RingModel
from nptcs.config.solvers.tyre import TyreGeometry
from nptcs.errors import InputError
from nptcs.fe.case import spoke_design
from nptcs.fe.energy_cache import shared_table
from nptcs.fe.spoke.energy_table import SpokeEnergyTable
from nptcs.fe.spoke.equilibrium import SpokeError
from nptcs.ring.surrogate.common_range import on_common_range
from nptcs.ring.surrogate.model import DESIGN, SpokeSurrogate

SPOKE = ["spacing_mm", "thickness_mm", "angle_deg", "spoke_c10_mpa"]
LEAST_RANGE = 0.75
"""Fraction of the options' range in compression that a table must cover to be fitted."""


def fit_surrogate(
    designs: pd.DataFrame,
    model: RingModel,
    tyre: TyreGeometry,
    ply: Mapping[str, float],
    folder: Path | None,
) -> SpokeSurrogate:
    """Fit the surrogate to all spokes of a design table.

    Spokes that lose their stability early have tables too short to fit with the others: they are
    left out, and the surrogate refuses designs that are nearer to them than to any other.

    Parameters
    ----------
    designs : DataFrame
        Columns of `SPOKE`; each spoke counts once.
    model : RingModel
    tyre : TyreGeometry
    ply : mapping
        The nine constants of the plates' ply.
    folder : Path or None
        Tables found there are read, others are computed and stored there.

    Raises
    ------
    InputError
        If a column is missing, or too few spokes have a table.
    """
    if missing := [name for name in SPOKE if name not in designs]:
        raise InputError("the design lacks a factor of the spoke", "add it", column=missing[0])
    parts = FeModel(**{name: getattr(model, name) for name in RingModel.spoke_parts()})
    spokes = designs[SPOKE].drop_duplicates().to_dict("records")
    found: list[tuple[list[float], SpokeEnergyTable]] = []
    short: list[list[float]] = []
    for values in spokes:
        design = spoke_design(parts, tyre, ply, {str(k): float(v) for k, v in values.items()})
        place = [float(design.plates), design.thickness_mm, design.angle_deg, design.c10_mpa]
        try:
            table = shared_table(parts, design, folder)
        except SpokeError:
            short.append(place)
            continue
        if table.low[0] > LEAST_RANGE * parts.table.elongation_mm[0]:
            short.append(place)
        else:
            found.append((place, table))
    tables = on_common_range([table for _, table in found]) if found else []
    places = np.array([place for place, _ in found]).reshape(-1, len(DESIGN))
    return SpokeSurrogate(places, tables, ply, unfitted=np.array(short).reshape(-1, len(DESIGN)))
