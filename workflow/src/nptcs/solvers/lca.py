"""The load-bearing analysis model as a solver: it sees the two rubbers and nothing else."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
import pandas as pd
from pydantic import Field

from nptcs import lca
from nptcs.arrays import Floating
from nptcs.config.solvers.tyre import TyreGeometry
from nptcs.errors import InputError
from nptcs.lca.any_spokes.wheel import ContactSpokes
from nptcs.lca.section import SectionKind, section_stiffness
from nptcs.lca.single import REMEDIES
from nptcs.lca.spokes.law_table import SpokeLawTable
from nptcs.lca.spokes.stiffness_table import OutOfRangeError, SpokeStiffnessTable
from nptcs.lca.state import LcaState
from nptcs.solvers.contract import (
    CASE_S,
    CaseInputs,
    Solver,
    SolverOptions,
    SolverResult,
    Status,
    TableInputs,
    neutral_line_columns,
)
from nptcs.solvers.tables import one_by_one

VERSION = "1"
SECTION_STIFFNESS = ("axial_stiffness_n", "shear_stiffness_n", "bending_stiffness_n_mm2")
SHARED = ("theta_c_deg", "theta_t_deg", "contact_force_n", "ring_force_n", "balance_residual")
"""Results that every model of the spokes reports."""
NEUTRAL_LINE_DEG = np.arange(-180.0, 181.0)
"""Angles of the neutral line."""


class LcaOptions(SolverOptions):
    """Options of the solver ``lca``."""

    case_s: float = Field(0.2, gt=0, description=CASE_S)
    section: SectionKind = Field(
        "sandwich", description="Section of the shear band: the physical one or section 3.3.3's"
    )
    spoke_stiffness_table: str = Field(
        "raw_data/published/table10_spoke_stiffness.csv",
        description="CSV with spoke_c10_mpa, tension_stiffness_n_per_mm and "
        "compression_stiffness_n_per_mm of one spoke; interpolated in C10, never extrapolated",
    )
    spoke_law_table: str | None = Field(
        None,
        description="CSV with spoke_c10_mpa, elongation_mm and force_n: force–displacement curves "
        "of one spoke, tension positive, that replace the two stiffnesses",
    )
    contact_spokes: ContactSpokes = Field(
        "paper",
        description="Spokes over the contact: all shortened by the wheel's displacement "
        "(equation 14), or each by the band's displacement at its position",
    )
    curve_points: int = Field(
        20, ge=2, le=1000, description="Points of the load–displacement curve, up to the load"
    )

    def tables(self) -> Mapping[str, str]:
        """Name the table of spoke stiffness, or that of spoke curves."""
        if self.spoke_law_table is not None:
            return {"spoke_law": self.spoke_law_table}
        return {"spoke_stiffness": self.spoke_stiffness_table}


def solve(inputs: CaseInputs) -> SolverResult:
    """Solve one case: ``shear_band_c10_mpa`` and ``spoke_c10_mpa`` at the load.

    Returns
    -------
    SolverResult
        ``error`` with a reason if the spokes' C10 is outside the table, or the load needs more
        displacement than the wheel has room for or the spokes' curve covers.
    """
    options: LcaOptions = inputs.options
    section = lca.ShearBandSection.from_tyre(
        inputs.tyre, inputs.values["shear_band_c10_mpa"], options.section
    )
    try:
        spokes = _spokes(inputs)
        if isinstance(spokes, lca.LinearSpokes):
            return _solve_linear(inputs, section, spokes)
        return _solve_law(inputs, section, spokes)
    except (OutOfRangeError, lca.ModelError) as reason:
        return SolverResult(status=Status.ERROR, message=str(reason))


def _room_mm(tyre: TyreGeometry) -> float:
    """Return the displacement at which the band meets the rim."""
    return tyre.band_radius_mm - tyre.rim_diameter_mm / 2


def _spokes(inputs: CaseInputs) -> lca.LinearSpokes | lca.SpokeLaw:
    """Read the spokes of the case's rubber; an error in the table names its file."""
    options: LcaOptions = inputs.options
    (key, path), c10 = next(iter(options.tables().items())), inputs.values["spoke_c10_mpa"]
    rows, count = inputs.tables[key], inputs.tyre.spoke_count
    try:
        if options.spoke_law_table is not None:
            return SpokeLawTable.from_rows(rows, count).law(c10)
        spokes = SpokeStiffnessTable.from_rows(rows).spokes(c10, count)
    except InputError as error:
        error.file = path
        raise
    if options.contact_spokes == "local":
        return lca.SpokeLaw.linear(spokes, _room_mm(inputs.tyre))
    return spokes


def _loads(inputs: CaseInputs) -> list[float]:
    """Return the loads of the curve without zero; the last is the case's own."""
    points = inputs.options.curve_points
    return [float(load) for load in inputs.load_n * np.arange(1, points + 1) / points]


def _solve_linear(
    inputs: CaseInputs, section: lca.ShearBandSection, spokes: lca.LinearSpokes
) -> SolverResult:
    """Solve the exact model of two stiffnesses."""
    room = _room_mm(inputs.tyre)
    state = lca.solve(section, spokes, load_n=inputs.load_n, largest_displacement_mm=room)
    loads = _loads(inputs)
    curve = lca.curve(section, spokes, load_n=loads, largest_displacement_mm=room)
    extra = {
        "tangent_stiffness_n_per_mm": state.tangent_stiffness_n_per_mm,
        "contact_length_mm": state.contact_length_mm,
        "mean_pressure_mpa": state.mean_pressure_mpa,
    }
    at = state.at(NEUTRAL_LINE_DEG)
    neutral_line = neutral_line_columns(NEUTRAL_LINE_DEG, at["u_r_mm"], at["u_theta_mm"])
    displacement = [float(value) for value in curve["displacement_mm"]]
    return _result(state, extra, displacement, loads, neutral_line)


def _solve_law(
    inputs: CaseInputs, section: lca.ShearBandSection, law: lca.SpokeLaw
) -> SolverResult:
    """Solve the model of a spoke curve at every load of the curve."""
    contact, loads = inputs.options.contact_spokes, _loads(inputs)
    states = [lca.solve_law(section, law, load_n=load, contact=contact) for load in loads]
    state, room = states[-1], _room_mm(inputs.tyre)
    if state.displacement_mm > room:
        raise lca.ModelError(
            f"load-bearing model: needs a displacement of {state.displacement_mm:.4g} mm, more "
            f"than the {room:.4g} mm that the wheel allows",
            remedy="give a smaller load, or a stiffer ring or spokes",
        )
    extra = {
        "lowest_elongation_mm": state.elongation_mm[0],
        "highest_elongation_mm": state.elongation_mm[1],
    }
    displacement = [each.displacement_mm for each in states]
    return _result(state, extra, displacement, loads, _law_neutral_line(state))


def _law_neutral_line(state: lca.LawState) -> dict[str, list[float]]:
    """Neutral line of smeared spokes, which is solved for one half: the other is its mirror."""
    points = state.points().sort_values("theta_deg")
    half, side = np.abs(NEUTRAL_LINE_DEG), np.sign(NEUTRAL_LINE_DEG)
    radial, along = (
        np.interp(half, points["theta_deg"], points[name]) for name in ("u_r_mm", "u_theta_mm")
    )
    return neutral_line_columns(NEUTRAL_LINE_DEG, radial, side * along)


def _result(
    state: LcaState | lca.LawState,
    extra: dict[str, float],
    displacement: list[float],
    force: list[float],
    neutral_line: dict[str, list[float]],
) -> SolverResult:
    """Return the contract's record of a solved state."""
    return SolverResult(
        status=Status.OK,
        message=state.doubts,
        vertical_stiffness_n_per_mm=state.stiffness_n_per_mm,
        displacement_mm=state.displacement_mm,
        extra={
            **{name: getattr(state, name) for name in SHARED},
            **extra,
        },
        curve={"displacement_mm": [0.0, *displacement], "force_n": [0.0, *force]},
        neutral_line=neutral_line,
    )


def solve_table(inputs: TableInputs) -> pd.DataFrame:
    """Solve many cases at once; spokes that follow a curve are solved case by case."""
    options: LcaOptions = inputs.options
    if options.spoke_law_table is not None or options.contact_spokes == "local":
        return one_by_one(solve)(inputs)
    band = inputs.cases["shear_band_c10_mpa"].to_numpy(float)
    spokes = _spoke_stiffness(inputs, inputs.cases["spoke_c10_mpa"].to_numpy(float))
    dimensions, room = inputs.tyre.model_dump(), _room_mm(inputs.tyre)
    with np.errstate(invalid="ignore"):
        stiffness = section_stiffness(dimensions, band, options.section)
    designs: dict[str, Any] = {
        **dict(zip(SECTION_STIFFNESS, stiffness, strict=True)),
        "radius_mm": inputs.tyre.band_radius_mm,
        "width_mm": inputs.tyre.tread_width_mm,
        **spokes,
        "spoke_count": inputs.tyre.spoke_count,
    }
    batch = lca.solve_batch(designs, load_n=inputs.load_n, largest_displacement_mm=room)
    numbers = dict(batch.columns)
    angle = np.radians(numbers["theta_c_deg"])
    solved = np.isin(batch.status, ("ok", "doubtful"))
    table = pd.DataFrame(
        {
            "status": np.where(solved, Status.OK.value, Status.ERROR.value),
            "message": batch.message,
            "vertical_stiffness_n_per_mm": numbers["stiffness_n_per_mm"],
            "displacement_mm": numbers["displacement_mm"],
            **{name: numbers[name] for name in SHARED},
            "tangent_stiffness_n_per_mm": numbers["tangent_stiffness_n_per_mm"],
            "contact_length_mm": 2 * inputs.tyre.band_radius_mm * angle,
            "mean_pressure_mpa": numbers["mean_pressure_mpa"],
        }
    )
    for row in np.flatnonzero(~solved):
        remedy = REMEDIES.get(str(batch.status[row]))
        if remedy is None:  # a rubber outside the table, or no rubber: refused before solving
            table.loc[row, "message"] = _refusal(inputs.case(int(row)))
        else:
            message = f"load-bearing model: {batch.message[row]}"
            table.loc[row, "message"] = str(lca.ModelError(message, remedy=remedy))
    return table


def _spoke_stiffness(inputs: TableInputs, c10_mpa: Floating) -> dict[str, Floating]:
    """Stiffness of the spokes of each case; NaN where the table has no such rubber."""
    key = next(iter(inputs.options.tables()))
    table = SpokeStiffnessTable.from_rows(inputs.tables[key])
    outside = ~((c10_mpa >= table.c10_mpa[0]) & (c10_mpa <= table.c10_mpa[-1]))
    within = np.where(outside, table.c10_mpa[0], c10_mpa)
    tension, compression = table.stiffness(within)
    return {
        "tension_n_per_mm": np.where(outside, np.nan, tension),
        "compression_n_per_mm": np.where(outside, np.nan, compression),
    }


def _refusal(inputs: CaseInputs) -> str:
    """Say why a case is not solved, as `solve` does."""
    try:
        return solve(inputs).message
    except InputError as error:
        return str(error)


SOLVER = Solver(
    name="lca",
    version=VERSION,
    solve=solve,
    factors=frozenset({"shear_band_c10_mpa", "spoke_c10_mpa"}),
    about="the load-bearing analysis model, which sees the two rubbers and nothing else",
    required=frozenset({"shear_band_c10_mpa", "spoke_c10_mpa"}),
    options=LcaOptions,
    solve_table=solve_table,
    table_case_s=1e-4,
)
