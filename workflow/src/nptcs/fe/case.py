"""One case of the study: its spoke's energy table and its loaded tyre."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from threadpoolctl import threadpool_limits

from nptcs.config.solvers.fe import FeModel, FeSpokeModel
from nptcs.config.solvers.tyre import TyreGeometry
from nptcs.fe.spoke.energy_table import SpokeEnergyTable
from nptcs.fe.spoke.period import SpokeDesign
from nptcs.fe.spoke.sampling import computed_table
from nptcs.fe.tyre.equilibrium import LoadPath, TyreError, TyreModel, TyreState


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
        # which ring a section was calibrated with changes no spoke: both rings share the tables
        geometry=model.geometry.as_drawn(),
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
    return computed_table(design, model.table)


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


@threadpool_limits.wrap(limits=1)
def path_to_displacement(
    assembled: TyreModel, model: FeModel, load_n: float, path: LoadPath, displacement_mm: float
) -> tuple[LoadPath, str]:
    """Load a tyre beyond the load of its case, in the same steps, to a given displacement.

    Parameters
    ----------
    assembled : TyreModel
    model : FeModel
    load_n : float
        Load of the case.
    path : LoadPath
        Path of the tyre to that load.
    displacement_mm : float

    Returns
    -------
    path : LoadPath
        To the displacement or a little further, or as far as the tyre could be loaded.
    reason : str
        Why the path ends before the displacement; empty if it does not.
    """
    step = load_n / model.load_steps
    while path.rise_mm[-1] < displacement_mm:
        slope = (path.force_n[-1] - path.force_n[-2]) / (path.rise_mm[-1] - path.rise_mm[-2])
        missing = slope * (displacement_mm - path.rise_mm[-1])
        last = path.force_n[-1] + max(missing, step)
        try:
            path = assembled.load((np.arange(1, np.ceil(last / step) + 1) * step).tolist()).path
        except TyreError as error:
            reached = error.path.rise_mm[-1] >= displacement_mm
            return error.path, "" if reached else str(error)
    return path, ""


def plate_volume_mm3(design: SpokeDesign, spokes: int) -> float:
    """Volume of all reinforcement plates of a tyre: both legs of every spoke."""
    section = design.geometry
    height = section.height_mm / 2.0 - section.plate_foot_gap_mm - section.plate_mid_gap_mm
    length = height / np.cos(np.radians(section.leg_angle_deg))
    one = length * design.plate_width_mm * design.thickness_mm
    return float(2 * design.plates * spokes * one)
