"""Solver ``fe_spoke``: one spoke pulled by 4 mm and compressed by 20 mm (section 4.3.1)."""

from __future__ import annotations

import numpy as np
from pydantic import Field

from nptcs.config.solvers.fe import FeSpokeModel
from nptcs.fe.case import spoke_design
from nptcs.fe.spoke.equilibrium import SpokeError, SpokeModel
from nptcs.fe.spoke.pull import spoke_stiffness
from nptcs.solvers.contract import (
    CASE_MEMORY,
    CASE_S,
    CaseInputs,
    Solver,
    SolverOptions,
    SolverResult,
    Status,
)
from nptcs.solvers.fe_inputs import SPOKE_FACTORS, checked_values, ply_constants, realised_spacing
from nptcs.solvers.spoke_responses import spoke_responses


class FeSpokeOptions(SolverOptions, FeSpokeModel):
    """Options of ``fe_spoke``: the finite element model of the spoke."""

    case_s: float = Field(10.0, gt=0, description=CASE_S)
    case_memory_mb: float = Field(250.0, gt=0, description=CASE_MEMORY)


def solve(inputs: CaseInputs) -> SolverResult:
    """Return the spoke's curve and its stiffness through the origin in tension and compression.

    Raises
    ------
    InputError
        If a value of the case is missing or has no meaning.
    """
    options: FeSpokeOptions = inputs.options
    values = checked_values(inputs, SPOKE_FACTORS)
    design = spoke_design(options, inputs.tyre, ply_constants(inputs), values)
    try:
        result = spoke_stiffness(SpokeModel(design), 16, 40)
    except SpokeError as error:
        return SolverResult(status=Status.DIVERGED, message=str(error))
    (pulled, pull_force), (pressed, press_force) = result.tension, result.compression
    displacement = np.concatenate([-pressed[:0:-1], pulled])
    force = np.concatenate([-press_force[:0:-1], pull_force])
    return SolverResult(
        status=Status.OK,
        extra=spoke_responses(result.tension_fit, result.compression_fit),
        curve={"displacement_mm": displacement.tolist(), "force_n": force.tolist()},
    )


SOLVER = Solver(
    name="fe_spoke",
    version="2",
    solve=solve,
    factors=SPOKE_FACTORS,
    about="one spoke pulled by 4 mm and compressed by 20 mm (section 4.3.1)",
    required=SPOKE_FACTORS,
    options=FeSpokeOptions,
    needs_ply=True,
    loads_tyre=False,
    realise=realised_spacing,
    preload=("nptcs.fe.elements.preloaded",),
)
