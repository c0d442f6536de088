"""One solver case in its own process."""

from __future__ import annotations

import math
import os
import resource
import signal
import sys
import tempfile
import threading
import time
import traceback
from multiprocessing import parent_process
from multiprocessing.connection import Connection

from nptcs.campaign.record import CaseJob
from nptcs.config.solvers.tyre import TyreGeometry
from nptcs.errors import SHORTAGES
from nptcs.processes.marked import MARK
from nptcs.processes.stops import leave_in_order
from nptcs.solvers.contract import CaseInputs, SolverResult, Status
from nptcs.solvers.external import end_all
from nptcs.solvers.registry import load_solver, read_options


def solve(job: CaseJob) -> SolverResult:
    """Solve a case; a solver that raises or leaves a response out gives status ``error``."""
    try:
        solver = load_solver(job.module)
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
        return SolverResult(
            status=Status.ERROR, message=message_of(error), died=of_the_machine(error)
        )


def message_of(error: Exception) -> str:
    """Name an exception and where it was raised, in one line."""
    where = traceback.extract_tb(error.__traceback__)[-1]
    file = os.path.basename(where.filename)  # noqa: PTH119 - a name, not a path to open
    return f"{type(error).__name__}: {error} ({file}, line {where.lineno})"


def of_the_machine(error: Exception) -> bool:
    """Tell whether an error says that the machine lacked something: disk space, open files."""
    return isinstance(error, OSError) and error.errno in SHORTAGES


def run(job: CaseJob, channel: Connection, folder: str) -> None:
    """Solve a case and send ``(result, wall time in s, memory in MB)`` back through the pipe."""
    begin_in(folder)
    start = time.perf_counter()
    result = solve(job)
    channel.send((result.model_dump_json(), time.perf_counter() - start, peak_memory_mb()))
    channel.close()


def begin_in(folder: str) -> None:
    """Let this process end cleanly on SIGTERM, and when the campaign that started it is gone.

    A solver's temporary files go to `folder`, and its commands carry this folder's mark; the
    campaign removes both when the process has ended.
    """
    tempfile.tempdir = os.environ["TMPDIR"] = os.environ[MARK] = folder
    signal.signal(signal.SIGTERM, leave_in_order)
    threading.Thread(target=_leave_with_parent, daemon=True).start()


def peak_memory_mb() -> float:
    """Return the largest memory of this process so far, in MB."""
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    return peak / (1e6 if sys.platform == "darwin" else 1e3)


def _leave_with_parent() -> None:
    """End this process when the campaign that started it is gone, however that ended."""
    parent = parent_process()
    if parent is not None:
        parent.join()
        end_all()
        os._exit(1)
