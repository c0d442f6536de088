"""Columns of result tables that belong to the run, not to what was computed."""

TIMES = ("wall_time_s", "fit_cpu_s", "leave_one_out_cpu_s", "search_cpu_s")
"""How long something took: another number in each run, so no part of a run's content."""

OF_THE_RUN = (*TIMES, "key", "solver_version")
"""Columns that belong to the run and to the code, not to the study."""
