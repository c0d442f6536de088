"""One thread for the linear algebra of each process: cases and jobs already share the cores.

Without a limit each process starts as many threads as there are cores, and several processes
slow each other down many times over. The libraries read these variables when they are loaded, so
entry points call this before anything imports NumPy.
"""

from __future__ import annotations

import os

VARIABLES = (
    "OMP_NUM_THREADS",
    "OPENBLAS_NUM_THREADS",
    "MKL_NUM_THREADS",
    "VECLIB_MAXIMUM_THREADS",
)


def one_thread_per_process() -> None:
    """Limit this process and those that it starts to one thread; a limit already set stays."""
    for name in VARIABLES:
        os.environ.setdefault(name, "1")
