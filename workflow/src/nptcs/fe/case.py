"""One case of the study: its spoke's table and its loaded tyre."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from threadpoolctl import threadpool_limits

from nptcs.config.fe import FeModel, FeSpokeModel
from nptcs.config.tyre import TyreGeometry
from nptcs.fe.spoke.energy_table import SpokeEnergyTable, fit
from nptcs.fe.spoke.equilibrium import SpokeFields, SpokeModel
from nptcs.fe.spoke.period import SpokeDesign
from nptcs.fe.spoke.sampling import Corrections, Place, no_correction, sampled_states, samples_of
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
        geometry=model.geometry,
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


def energy_table(model: FeModel, design: SpokeDesign) -> SpokeEnergyTable:
    """Compute the energy table of one spoke."""
    return table_with_corrections(model, design, no_correction)[0]


@threadpool_limits.wrap(limits=1)
def table_with_corrections(
    model: FeModel, design: SpokeDesign, corrections: Corrections
) -> tuple[SpokeEnergyTable, dict[Place, SpokeFields]]:
    """Compute the energy table of one spoke, and what may help to compute that of another.

    Parameters
    ----------
    model : FeModel
    design : SpokeDesign
    corrections : callable
        Of the place of a state in the table's grid, see `sampled_states`.

    Returns
    -------
    table : SpokeEnergyTable
    corrections : dict of place to SpokeFields
        This spoke's own.
    """
    height_mm = design.geometry.height_mm
    spoke = SpokeModel(design, model.table.accepted_work)
    sampled = sampled_states(spoke, model.table, corrections)
    return fit(samples_of(sampled.states, height_mm), model.table, height_mm), sampled.corrections


def tyre_model(
    model: FeModel, tyre: TyreGeometry, table: SpokeEnergyTable, band_c10_mpa: float
) -> TyreModel:
    """Assemble the tyre of one case."""
    return TyreModel(
        tyre,
        table,
        model.geometry.foot_width_mm(),
        band_c10_mpa,
        model.spoke_mesh.bulk_to_shear_ratio,
        model.tyre_mesh,
        model.contact,
    )


@threadpool_limits.wrap(limits=1)
def loaded_tyre(assembled: TyreModel, model: FeModel, load_n: float) -> TyreState:
    """Load a tyre in equal steps."""
    return assembled.load(np.linspace(0.0, load_n, model.load_steps + 1)[1:].tolist())
