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
    code = f"import sys, {', '.join(DATA)}; print('matplotlib' in sys.modules)"
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)}
    run = [sys.executable, "-c", code]
    answer = subprocess.run(run, env=environment, capture_output=True, text=True, check=True)
    assert answer.stdout.strip() == "False"
