"""Solver ``calculix``: the spoke of ``fe_spoke`` with meshed plies, solved by the user's ccx."""

from __future__ import annotations

import tempfile
from pathlib import Path

import numpy as np
from pydantic import Field

from nptcs.config.solvers.fe import FeSpokeModel, LayerlessGeometry, SpokeGeometry
from nptcs.decks.calculix import complaints, spoke_deck, total_forces, true_thickness
from nptcs.fe.case import spoke_design
from nptcs.fe.spoke.pull import COMPRESSION_MM, TENSION_MM
from nptcs.fe.spoke.stiffness_line import stiffness_line
from nptcs.solvers.contract import (
    CASE_MEMORY,
    CASE_S,
    CaseInputs,
    Solver,
    SolverOptions,
    SolverResult,
    Status,
)
from nptcs.solvers.external import CommandStopped, run_command, time_for_command
from nptcs.solvers.fe_inputs import SPOKE_FACTORS, checked_values, ply_constants, realised_spacing
from nptcs.solvers.spoke_responses import spoke_responses

STEPS = 4


class CalculixOptions(SolverOptions, FeSpokeModel):
    """Options of ``calculix``: the spoke's model and the command that solves it."""

    case_s: float = Field(60.0, gt=0, description=CASE_S)
    case_memory_mb: float = Field(500.0, gt=0, description=CASE_MEMORY)
    geometry: LayerlessGeometry = Field(default_factory=SpokeGeometry, description="The spoke")
    command: tuple[str, ...] = Field(
        ("ccx",), min_length=1, description="Command; the job's name is added as its last argument"
    )


def solve(inputs: CaseInputs) -> SolverResult:
    """Pull and compress one spoke with CalculiX, and fit table 10's lines through the origin.

    Raises
    ------
    InputError
        If a value of the case is missing or has no meaning.
    """
    options: CalculixOptions = inputs.options
    values = checked_values(inputs, SPOKE_FACTORS)
    design = spoke_design(options, inputs.tyre, ply_constants(inputs), values)
    pulled = np.linspace(0.0, TENSION_MM, STEPS + 1)[1:]
    pressed = np.linspace(0.0, COMPRESSION_MM, STEPS + 1)[1:]
    deck = spoke_deck(true_thickness(design), [*pulled.tolist(), *(-pressed).tolist()])
    with tempfile.TemporaryDirectory(prefix="nptcs-ccx-") as folder:
        (Path(folder) / "spoke.inp").write_text(deck, encoding="ascii")
        try:
            ended = run_command(
                [*options.command, "spoke"], Path(folder), time_for_command(options.timeout_s)
            )
        except CommandStopped as stopped:
            return SolverResult(status=stopped.status, message=str(stopped))
        if found := complaints(ended.output):
            return SolverResult(status=Status.ERROR, message=found)
        answer = Path(folder) / "spoke.dat"
        force = total_forces(answer.read_text()) if answer.exists() else np.empty((0, 3))
    radial = force[:, 2] * design.plates
    curve = _curve(np.concatenate([pulled, -pressed])[: len(radial)], radial)
    if ended.code != 0 or len(force) < 2 * STEPS:
        return SolverResult(
            status=Status.DIVERGED,
            curve=curve,
            message=f"{options.command[0]} ended with code {ended.code} after {len(force)} of "
            f"{2 * STEPS} steps: {ended.output.strip()[-500:]}",
        )
    lines = stiffness_line(pulled, radial[:STEPS]), stiffness_line(pressed, -radial[STEPS:])
    return SolverResult(
        status=Status.OK,
        extra=spoke_responses(*lines),
        curve=curve,
    )


def _curve(displacement_mm: np.ndarray, force_n: np.ndarray) -> dict[str, list[float]]:
    """Order the steps, and the unloaded spoke with them, from compression to tension."""
    order = np.argsort([0.0, *displacement_mm])
    return {
        "displacement_mm": np.array([0.0, *displacement_mm])[order].tolist(),
        "force_n": np.array([0.0, *force_n])[order].tolist(),
    }


SOLVER = Solver(
    name="calculix",
    version="1",
    solve=solve,
    factors=SPOKE_FACTORS,
    about="the spoke of fe_spoke with meshed plies, solved by the user's ccx",
    required=SPOKE_FACTORS,
    options=CalculixOptions,
    needs_ply=True,
    loads_tyre=False,
    realise=realised_spacing,
)
