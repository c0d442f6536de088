"""One case of the study: its spoke's table and its loaded tyre."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from threadpoolctl import threadpool_limits

from nptcs.config.fe import FeModel, FeSpokeModel
from nptcs.config.tyre import TyreGeometry
from nptcs.fe.spoke.energy_table import SpokeEnergyTable, fit, sample
from nptcs.fe.spoke.equilibrium import SpokeDesign, SpokeModel
from nptcs.fe.tyre.equilibrium import TyreModel, TyreState


def spoke_design(
    model: FeSpokeModel, tyre: TyreGeometry, ply: Mapping[str, float], values: Mapping[str, float]
) -> SpokeDesign:
    """Collect what the spoke of a case depends on.

    Parameters
    ----------
    model : FeSpokeModel
    tyre : TyreGeometry
    ply : mapping
        The nine ply constants.
    values : mapping
        ``spacing_mm``, ``thickness_mm``, ``angle_deg``, ``spoke_c10_mpa``.
    """
    plates = tyre.plates_across(values["spacing_mm"])
    return SpokeDesign(
        # what it was calibrated with changes nothing: both rings share the tables of equal spokes
        geometry=model.geometry.model_copy(update={"calibrated_with": None}),
        mesh=model.spoke_mesh,
        pitch_mm=tyre.tread_width_mm / plates,
        plate_width_mm=tyre.plate_width_mm,
        thickness_mm=values["thickness_mm"],
        angle_deg=values["angle_deg"],
        c10_mpa=values["spoke_c10_mpa"],
        ply=dict(ply),
        plates=plates,
        plate_coupling=model.plate_coupling,
    )


@threadpool_limits.wrap(limits=1)
def energy_table(model: FeModel, design: SpokeDesign) -> SpokeEnergyTable:
    """Compute the energy table of one spoke."""
    return fit(sample(SpokeModel(design), model.table), model.table, design.geometry.height_mm)


def tyre_model(
    model: FeModel, tyre: TyreGeometry, table: SpokeEnergyTable, band_c10_mpa: float
) -> TyreModel:
    """Assemble the tyre of one case."""
    return TyreModel(
        tyre,
        table,
        model.geometry.foot_width_mm(),
        band_c10_mpa,
        model.band_bulk_to_shear(),
        model.ring_mesh(),
        model.contact,
    )


@threadpool_limits.wrap(limits=1)
def loaded_tyre(assembled: TyreModel, model: FeModel, load_n: float) -> TyreState:
    """Load a tyre in equal steps."""
    return assembled.load(np.linspace(0.0, load_n, model.load_steps + 1)[1:].tolist())
