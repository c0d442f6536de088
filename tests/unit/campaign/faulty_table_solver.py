"""A solver of tables for the tests: the value of a case's factor decides how its table ends."""

import os
import signal
import time

import numpy as np
import pandas as pd

from nptcs.solvers.contract import Solver, SolverOptions, SolverResult, Status


def solve(inputs):
    stiffness = 100.0 + inputs.values["kind"]
    return SolverResult(
        status=Status.OK,
        vertical_stiffness_n_per_mm=stiffness,
        displacement_mm=inputs.load_n / stiffness,
    )


def solve_table(inputs):
    kinds = set(inputs.cases["kind"])
    if 1.0 in kinds:
        raise RuntimeError("the mesh has folded")
    if 2.0 in kinds:
        time.sleep(600)
    if 3.0 in kinds:
        os.kill(os.getpid(), signal.SIGKILL)
    if 4.0 in kinds:
        os.kill(os.getpid(), signal.SIGSEGV)
    if 7.0 in kinds:
        raise MemoryError("no room for 8 GB")
    stiffness = 100.0 + inputs.cases["kind"].to_numpy(float)
    return pd.DataFrame(
        {
            "status": "ok",
            "message": "",
            # kind 5 says ok and gives nothing
            "vertical_stiffness_n_per_mm": np.where(stiffness == 105.0, np.nan, stiffness),
            "displacement_mm": inputs.load_n / stiffness,
            "process": float(os.getpid()),
        }
    )


class Options(SolverOptions):
    timeout_s: float = 1.0


SOLVER = Solver(
    name="faulty",
    version="1",
    about="does to its table as the cases say",
    solve=solve,
    factors=frozenset({"kind"}),
    required=frozenset({"kind"}),
    options=Options,
    solve_table=solve_table,
)
