"""Scripts stay thin: what they do beyond reading and writing belongs in the package."""

import subprocess
import sys
from pathlib import Path

import pytest

SCRIPTS = sorted((Path(__file__).parents[2] / "workflow" / "scripts").glob("*.py"))


@pytest.mark.parametrize("script", SCRIPTS, ids=lambda script: script.stem)
def test_a_script_is_short_and_unpacks_by_keyword(script):
    text = script.read_text(encoding="utf-8")
    assert text.count("\n") <= 30
    edge = text[text.index('if __name__ == "__main__":') :]
    assert "(**snakemake.params, " in edge
    assert "**snakemake.output)" in edge
    assert "snakemake." not in text[: -len(edge)]


LIBRARIES = ["numba", "numpy", "pandas", "pandera.pandas", "scipy.optimize", "sklearn", "SALib"]


@pytest.mark.parametrize("library", LIBRARIES)
def test_no_script_is_taken_for_a_module_of_a_library(library):
    """Snakemake puts the scripts' folder on the path: numba once took ours for `coverage`."""
    pytest.importorskip(library.split(".")[0])
    code = f"import sys; sys.path.append({str(SCRIPTS[0].parent)!r}); import {library}"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr[-500:]
