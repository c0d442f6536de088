"""One solver case in a process of its own."""

from __future__ import annotations

import math
import os
import resource
import signal
import sys
import threading
import time
import traceback
from multiprocessing import parent_process
from multiprocessing.connection import Connection
from types import FrameType

from nptcs.campaign.record import CaseJob
from nptcs.config.tyre import TyreGeometry
from nptcs.solvers.contract import CaseInputs, SolverResult, Status
from nptcs.solvers.external import end_all
from nptcs.solvers.registry import load, read_options


def solve(job: CaseJob) -> SolverResult:
    """Solve a case; a solver that raises or leaves a response out gives status ``error``."""
    try:
        solver = load(job.module)
        inputs = CaseInputs(
            case_id=job.case_id,
            values=job.values,
            load_n=math.nan if job.load_n is None else job.load_n,
            tyre=TyreGeometry.model_validate(job.tyre),
            options=read_options(solver, job.options),
            ply=job.ply,
            tables=job.tables,
        )
        result = SolverResult.model_validate(solver.solve(inputs))
        if missing := solver.missing_responses(result):
            return SolverResult(
                status=Status.ERROR,
                message=f"solver '{solver.name}' says ok but gives no {', '.join(missing)}",
            )
        if solver.realise is not None and result.status.solved:
            realised = solver.realise(inputs.values, inputs.tyre)
            result.realised = {**realised, **result.realised}
        return result
    except MemoryError as error:
        return SolverResult(status=Status.ERROR, message=f"out of memory: {error}", died=True)
    except Exception as error:  # noqa: BLE001 - any fault of a solver is a row, not a crash
        where = traceback.extract_tb(error.__traceback__)[-1]
        file = os.path.basename(where.filename)  # noqa: PTH119 - a name, not a path to open
        return SolverResult(
            status=Status.ERROR,
            message=f"{type(error).__name__}: {error} ({file}, line {where.lineno})",
        )


def run(job: CaseJob, channel: Connection) -> None:
    """Solve a case and send ``(result, wall time in s, memory in MB)`` back through the pipe."""
    signal.signal(signal.SIGTERM, _leave)
    threading.Thread(target=_leave_with_parent, daemon=True).start()
    start = time.perf_counter()
    result = solve(job)
    channel.send((result.model_dump_json(), time.perf_counter() - start, _peak_memory_mb()))
    channel.close()


def _peak_memory_mb() -> float:
    """Return the largest memory of this process so far, in MB."""
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    return peak / (1e6 if sys.platform == "darwin" else 1e3)


def _leave(number: int, frame: FrameType | None) -> None:
    """Leave in order, so that a solver can end the commands that it has started."""
    raise SystemExit(128 + number)


def _leave_with_parent() -> None:
    """End this process when the campaign that started it is gone, however that ended."""
    parent = parent_process()
    if parent is not None:
        parent.join()
        end_all()
        os._exit(1)
