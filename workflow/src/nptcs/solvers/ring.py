"""Solver ``ring``: the tyre as a sandwich ring on the energies of finite element spokes."""

from __future__ import annotations

from pathlib import Path
from typing import ClassVar, Literal

import numpy as np
from pydantic import Field

from nptcs.arrays import Array
from nptcs.config.solvers.fe import FeModel
from nptcs.config.solvers.ring import RingModel
from nptcs.errors import InputError
from nptcs.fe.case import plate_volume_mm3, spoke_design
from nptcs.fe.energy_cache import shared_table
from nptcs.fe.output.loaded_spokes import loaded_spokes
from nptcs.fe.spoke.energy_table import SpokeEnergyTable
from nptcs.fe.spoke.equilibrium import SpokeError, SpokeModel
from nptcs.fe.spoke.period import SpokeDesign
from nptcs.fe.tyre.responses import spoke_forces
from nptcs.ring.responses import responses
from nptcs.ring.solution import RingError, RingState, press_through_loads
from nptcs.ring.tyre import RingTyre, ring_tyre
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
from nptcs.solvers.tables import one_by_one


class RingSolverOptions(SolverOptions, RingModel):
    """Options of ``ring``: the ring, its spokes and where these are stored."""

    without_effect: ClassVar[frozenset[str]] = SolverOptions.without_effect | {"spoke_cache"}

    case_s: float = Field(15.0, gt=0, description=CASE_S)
    case_memory_mb: float = Field(300.0, gt=0, description=CASE_MEMORY)
    plate_stress: Literal["all", "off"] = Field(
        "off",
        description="all: the most loaded spokes are solved again at their motion in the "
        "tyre, as by `fe_tyre`, for the stress of plates and rubber, which takes a hundred times "
        "as long as the ring; off: those responses are not assessed",
    )
    spoke_cache: Path | None = Field(
        None,
        description="Folder in which cases share the tables of equal spokes, also with `fe_tyre`; "
        "results do not depend on it",
    )


def solve(inputs: CaseInputs) -> SolverResult:
    """Return the load–displacement curve and the secant stiffness at the load of the case.

    Raises
    ------
    InputError
        If a value of the case is missing or has no meaning, or the tyre's dimensions contradict
        each other.
    """
    options: RingSolverOptions = inputs.options
    values = checked_values(inputs, TYRE_FACTORS)
    design = spoke_design(options, inputs.tyre, ply_constants(inputs), values)
    # the tables depend on these parts of the finite element model alone
    spokes = FeModel(**{name: getattr(options, name) for name in RingModel.spoke_parts()})
    try:
        table = shared_table(spokes, design, options.spoke_cache)
    except SpokeError as error:
        return SolverResult(status=Status.DIVERGED, message=f"spoke: {error}")
    try:
        tyre = ring_tyre(inputs.tyre, table, values["shear_band_c10_mpa"], options)
    except ValueError as error:
        raise InputError(
            str(error),
            "correct the tyre's dimensions or the ring's options",
            column="tyre",
            specimen=inputs.case_id,
        ) from error
    loads = np.linspace(0.0, inputs.load_n, options.load_steps + 1)[1:]
    try:
        states = press_through_loads(tyre, loads.tolist())
    except RingError as error:
        return SolverResult(status=Status.DIVERGED, message=str(error), curve=_curve(error.states))
    last = states[-1]
    plates, rubber, note = _inside(options, design, table, tyre.spoke_motion(last.u))
    notes = [*options.geometry.axial_notes(options.axial), *([note] if note else [])]
    return SolverResult(
        status=Status.OK,
        message="; ".join(notes),
        vertical_stiffness_n_per_mm=inputs.load_n / last.rise_mm,
        displacement_mm=last.rise_mm,
        extra={
            "table_force_residual_n": table.force_residual_n,
            "plate_volume_mm3": plate_volume_mm3(design, inputs.tyre.spoke_count),
            **responses(tyre, last),
            **spoke_forces(table, tyre.spoke_motion(last.u)),
            **rubber,
            "iterations": float(sum(state.iterations for state in states)),
        },
        curve=_curve(states),
        plate_stress=plates,
        neutral_line=_neutral_line(tyre, last),
    )


def _inside(
    options: RingSolverOptions, design: SpokeDesign, table: SpokeEnergyTable, motion: Array
) -> tuple[dict[str, list[float]] | None, dict[str, float], str]:
    """Stress of the plates, responses of the spokes' rubber, and why there are none."""
    if options.plate_stress == "off":
        return None, {}, ""
    try:
        return *loaded_spokes(SpokeModel(design), table, motion), ""
    except SpokeError as error:
        return None, {}, f"stress of plates and spokes' rubber not assessed: {error}"


def _curve(states: list[RingState]) -> dict[str, list[float]]:
    return {
        "displacement_mm": [0.0, *(state.rise_mm for state in states)],
        "force_n": [0.0, *(state.force_n for state in states)],
    }


def _neutral_line(tyre: RingTyre, state: RingState) -> dict[str, list[float]]:
    outward, along = tyre.neutral_line(state.u)
    return neutral_line_columns(np.degrees(tyre.nodes.theta), outward, along)


SOLVER = Solver(
    name="ring",
    version="6",
    solve=solve,
    factors=TYRE_FACTORS,
    required=TYRE_FACTORS,
    options=RingSolverOptions,
    needs_ply=True,
    realise=realised_spacing,
    about="the tyre as a sandwich ring on the energies of finite element spokes",
    solve_table=one_by_one(solve),
    table_cases=10,
    shares=SPOKE_FACTORS,
    shared_case_s=0.1,
)
