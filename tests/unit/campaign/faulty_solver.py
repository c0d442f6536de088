"""A solver for the tests: the value of its factor decides how the case ends."""

import os
import signal
import time

from nptcs.solvers.contract import Solver, SolverOptions, SolverResult, Status


def solve(inputs):
    kind = inputs.values["kind"]
    if kind == 1:
        raise RuntimeError("the mesh has folded")
    if kind == 2:
        time.sleep(600)
    if kind == 3:
        os.kill(os.getpid(), signal.SIGKILL)
    if kind == 4:
        os._exit(3)
    if kind == 5:
        return SolverResult(status=Status.LICENCE, message="no token")
    if kind == 6:
        return {"status": "ok", "no_such_field": 1}
    if kind == 7:
        raise MemoryError("no room for 8 GB")
    if kind == 8:
        os.kill(os.getpid(), signal.SIGABRT)
    stiffness = 100 + 10 * kind + inputs.values["other"] ** 2
    return SolverResult(
        status=Status.OK,
        vertical_stiffness_n_per_mm=stiffness,
        displacement_mm=inputs.load_n / stiffness,
        extra={"threads": float(os.environ["OPENBLAS_NUM_THREADS"])},
    )


class Options(SolverOptions):
    timeout_s: float = 2.0


SOLVER = Solver(
    name="faulty",
    version="1",
    about="ends as its factor says",
    solve=solve,
    factors=frozenset({"kind", "other"}),
    required=frozenset({"kind", "other"}),
    options=Options,
)
