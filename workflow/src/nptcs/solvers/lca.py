"""The load-bearing analysis model as a solver: it sees the two rubbers, nothing else."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, Literal

import numpy as np
from pydantic import Field

from nptcs import lca
from nptcs.errors import InputError
from nptcs.lca.spoke_table import OutOfRangeError, SpokeTable
from nptcs.lca.state import LcaState
from nptcs.solvers.contract import CaseInputs, Solver, SolverOptions, SolverResult, Status

VERSION = "1"


class LcaOptions(SolverOptions):
    """Options of the solver ``lca``."""

    section: Literal["sandwich", "printed"] = Field(
        "sandwich", description="Section of the shear band: the physical one or section 3.3.3's"
    )
    spoke_stiffness_table: str = Field(
        "raw_data/published/table10_spoke_stiffness.csv",
        description="CSV with spoke_c10_mpa, tension_stiffness_n_per_mm and "
        "compression_stiffness_n_per_mm of one spoke; interpolated in C10, never extrapolated",
    )
    curve_points: int = Field(
        20, ge=2, le=1000, description="Points of the load–displacement curve, up to the load"
    )

    def tables(self) -> Mapping[str, str]:
        """Name the table of spoke stiffness."""
        return {"spoke_stiffness": self.spoke_stiffness_table}


def solve(inputs: CaseInputs) -> SolverResult:
    """Solve one case: ``shear_band_c10_mpa`` and ``spoke_c10_mpa`` at the load.

    Returns
    -------
    SolverResult
        ``error`` with a reason where the spokes' C10 lies outside the table or the load needs
        more displacement than the wheel has room for.
    """
    options: LcaOptions = inputs.options
    section = lca.RingSection.from_tyre(
        inputs.tyre, inputs.values["shear_band_c10_mpa"], options.section
    )
    table = _spoke_table(inputs.tables["spoke_stiffness"], options.spoke_stiffness_table)
    try:
        spokes = table.spokes(inputs.values["spoke_c10_mpa"], inputs.tyre.spoke_count)
    except OutOfRangeError as reason:
        return SolverResult(status=Status.ERROR, message=str(reason))
    limit = inputs.tyre.band_radius_mm - inputs.tyre.rim_diameter_mm / 2
    try:
        state = lca.solve(section, spokes, load_n=inputs.load_n, largest_displacement_mm=limit)
    except lca.ModelError as reason:
        return SolverResult(status=Status.ERROR, message=str(reason))
    loads = inputs.load_n * np.arange(1, options.curve_points + 1) / options.curve_points
    curve = lca.curve(section, spokes, load_n=loads)
    return _result(state, [0.0, *curve["displacement_mm"]], [0.0, *loads])


def _spoke_table(rows: Sequence[Mapping[str, Any]], path: str) -> SpokeTable:
    """Read the spoke stiffness, with the table's name in any complaint."""
    try:
        return SpokeTable.from_rows(rows)
    except InputError as error:
        error.file = path
        raise


def _result(state: LcaState, displacement: list[float], force: list[float]) -> SolverResult:
    """Return the contract's record of a solved state."""
    return SolverResult(
        status=Status.OK,
        message=state.doubts,
        vertical_stiffness_n_per_mm=state.stiffness_n_per_mm,
        displacement_mm=state.displacement_mm,
        extra={
            "theta_c_deg": state.theta_c_deg,
            "theta_t_deg": state.theta_t_deg,
            "contact_force_n": state.contact_force_n,
            "ring_force_n": state.ring_force_n,
            "tangent_stiffness_n_per_mm": state.tangent_stiffness_n_per_mm,
            "contact_length_mm": state.contact_length_mm,
            "mean_pressure_mpa": state.mean_pressure_mpa,
            "balance_residual": state.balance_residual,
        },
        curve={"displacement_mm": displacement, "force_n": force},
    )


SOLVER = Solver(
    name="lca",
    version=VERSION,
    solve=solve,
    factors=frozenset({"shear_band_c10_mpa", "spoke_c10_mpa"}),
    required=frozenset({"shear_band_c10_mpa", "spoke_c10_mpa"}),
    options=LcaOptions,
)
