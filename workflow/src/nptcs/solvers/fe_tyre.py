"""Solver ``fe_tyre``: the tyre on spoke super-elements, pressed against a rigid plane."""

from __future__ import annotations

from pathlib import Path
from typing import ClassVar, Literal

import numpy as np
from pydantic import Field

from nptcs.config.solvers.fe import FeModel
from nptcs.fe.case import (
    loaded_tyre,
    path_to_displacement,
    plate_volume_mm3,
    spoke_design,
    tyre_model,
)
from nptcs.fe.energy_cache import shared_table
from nptcs.fe.output.loaded_spokes import loaded_spokes
from nptcs.fe.spoke.equilibrium import SpokeError, SpokeModel
from nptcs.fe.tyre.equilibrium import LoadPath, TyreError, TyreModel, TyreState
from nptcs.fe.tyre.responses import contact_responses, spoke_forces, wire_wrinkle_mm
from nptcs.solvers.contract import (
    CASE_MEMORY,
    CASE_S,
    CaseInputs,
    Solver,
    SolverOptions,
    SolverResult,
    Status,
    neutral_line_columns,
)
from nptcs.solvers.fe_inputs import (
    SPOKE_FACTORS,
    TYRE_FACTORS,
    checked_values,
    ply_constants,
    realised_spacing,
)

# fraction of a wire's diameter
LARGEST_WRINKLE = 0.25


class FeTyreOptions(SolverOptions, FeModel):
    """Options of ``fe_tyre``: the finite element model and where spokes are stored."""

    without_effect: ClassVar[frozenset[str]] = SolverOptions.without_effect | {"spoke_cache"}

    case_s: float = Field(20.0, gt=0, description=CASE_S)
    case_memory_mb: float = Field(300.0, gt=0, description=CASE_MEMORY)
    plate_stress: Literal["all", "off"] = Field(
        "all",
        description="all: the most loaded spokes are solved again at their motion in the tyre, for "
        "the stress of plates and rubber; off: those responses are not assessed",
    )
    curve_to_mm: float | None = Field(
        None,
        gt=0,
        description="Continue beyond the load of the case to this displacement, for example 25 for "
        "the stiffness at 25 mm; the curve then takes two to four times as long",
    )
    spoke_cache: Path | None = Field(
        None,
        description="Folder in which cases share the tables of equal spokes; results do not "
        "depend on it",
    )


def solve(inputs: CaseInputs) -> SolverResult:
    """Return the load–displacement curve and the secant stiffness at the load of the case.

    Raises
    ------
    InputError
        If a value of the case is missing or has no meaning.
    """
    options: FeTyreOptions = inputs.options
    values = checked_values(inputs, TYRE_FACTORS)
    design = spoke_design(options, inputs.tyre, ply_constants(inputs), values)
    try:
        table = shared_table(options, design, options.spoke_cache)
        tyre = tyre_model(options, inputs.tyre, table, values["shear_band_c10_mpa"])
        state = loaded_tyre(tyre, options, inputs.load_n)
    except SpokeError as error:
        return SolverResult(status=Status.DIVERGED, message=f"spoke: {error}")
    except TyreError as error:
        return SolverResult(status=Status.DIVERGED, message=str(error), curve=_curve(error.path))
    path = state.path
    notes = options.geometry.axial_notes(options.axial)
    notes += _wrinkles(tyre, state, inputs.tyre.wire_diameter_mm)
    if options.curve_to_mm is not None:
        target = options.curve_to_mm
        path, reason = path_to_displacement(tyre, options, inputs.load_n, path, target)
        notes += [f"{target:g} mm not reached: {reason}"] if reason else []
    extra = {
        "table_force_residual_n": table.force_residual_n,
        "plate_volume_mm3": plate_volume_mm3(design, inputs.tyre.spoke_count),
        **_summary(tyre, state),
    }
    plates = None
    if options.plate_stress == "all":
        try:
            plates, rubber = loaded_spokes(SpokeModel(design), table, state.motion)
            extra |= rubber
        except SpokeError as error:
            notes.append(f"stress of plates and spokes' rubber not assessed: {error}")
    return SolverResult(
        status=Status.OK,
        message="; ".join(notes),
        vertical_stiffness_n_per_mm=inputs.load_n / state.rise_mm,
        displacement_mm=state.rise_mm,
        extra=extra,
        curve=_curve(path),
        plate_stress=plates,
        neutral_line=_neutral_line(tyre, state),
    )


def _neutral_line(tyre: TyreModel, state: TyreState) -> dict[str, list[float]]:
    """Displacement of the band's middle, in the directions of the undeformed ring."""
    theta = tyre.mesh.theta
    start = tyre.neutral_line(np.zeros_like(state.displacement))
    x, y = (tyre.neutral_line(state.displacement) - start).T
    outward = x * np.sin(theta) - y * np.cos(theta)
    along = x * np.cos(theta) + y * np.sin(theta)
    return neutral_line_columns(np.degrees(theta), outward, along)


def _curve(path: LoadPath) -> dict[str, list[float]]:
    return {"displacement_mm": path.rise_mm, "force_n": path.force_n}


def _wrinkles(tyre: TyreModel, state: TyreState, wire_mm: float) -> list[str]:
    """Say so if membranes wrinkle: the stiffness then depends on the mesh."""
    wave = wire_wrinkle_mm(tyre.mesh, state.displacement)
    if wave is None or wave < LARGEST_WRINKLE * wire_mm:
        return []
    return [
        f"the wires, which are membranes here, wrinkle from node to node by {wave:.2f} mm, which "
        "makes the tyre softer: the solver fe_tyre, whose wires bend, has no such wave"
    ]


def _summary(tyre: TyreModel, state: TyreState) -> dict[str, float]:
    """Contact patch, spokes' motions and forces, and energies at the load."""
    energy = tyre.energy(state)
    wrinkle = wire_wrinkle_mm(tyre.mesh, state.displacement)
    return {
        **({} if wrinkle is None else {"wire_wrinkle_mm": wrinkle}),
        **contact_responses(tyre.ground.cells(state.displacement, state.rise_mm)),
        "smallest_u_r_mm": float(state.motion[:, 0].min()),
        "largest_u_r_mm": float(state.motion[:, 0].max()),
        **spoke_forces(tyre.table, state.motion),
        "spoke_energy_n_mm": energy["spokes"],
        "band_energy_n_mm": energy["rubber"] + energy["wires"],
        "iterations": float(state.path.iterations),
    }


SOLVER = Solver(
    name="fe_tyre",
    version="4",
    solve=solve,
    factors=TYRE_FACTORS,
    about="the tyre on spoke super-elements, pressed against a rigid plane",
    required=TYRE_FACTORS,
    options=FeTyreOptions,
    needs_ply=True,
    realise=realised_spacing,
    preload=("nptcs.fe.elements.preloaded",),
    shares=SPOKE_FACTORS,
    shared_case_s=5.0,
)
