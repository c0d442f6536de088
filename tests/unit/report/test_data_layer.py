"""The data of a report are read without a plotting library."""

import os
import subprocess
import sys

import pytest

from nptcs.provenance import imported_modules

DATA = ["nptcs.report.data", "nptcs.report.tables.sheets", "nptcs.report.workbook.build"]


@pytest.mark.parametrize("module", DATA)
def test_no_module_of_figures_is_imported(module):
    assert not {name for name in imported_modules(module) if "figures" in name}


def test_no_plotting_library_is_loaded():
    assert "matplotlib" not in loaded_by(DATA)


def test_a_page_whose_figures_are_kept_loads_nothing_that_draws_or_fits():
    loaded = loaded_by(["nptcs.report.html", "nptcs.report.plots"])
    assert "pandas" in loaded
    assert not {"matplotlib", "sklearn", "scipy.stats", "openpyxl"} & loaded


def loaded_by(modules):
    """Name all modules that are loaded once these are imported."""
    code = f"import sys, {', '.join(modules)}; print(*sys.modules)"
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)}
    run = [sys.executable, "-c", code]
    answer = subprocess.run(run, env=environment, capture_output=True, text=True, check=True)
    return set(answer.stdout.split())
