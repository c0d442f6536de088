"""Files of real laboratories with known answers; skipped where the folder is absent."""

from __future__ import annotations

import importlib.util
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[3]
LABDATA = ROOT.parent / "shared" / "labdata"

pytestmark = pytest.mark.skipif(not LABDATA.is_dir(), reason="../shared/labdata is absent")


def _benchmark():
    spec = importlib.util.spec_from_file_location(
        "ingest_known_answers", ROOT / "benchmarks" / "ingest_known_answers.py"
    )
    module = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = module
    spec.loader.exec_module(module)
    return module


BENCHMARK = _benchmark()


@pytest.mark.parametrize("one", BENCHMARK.SETS, ids=lambda one: one.__name__)
def test_known_answer(one):
    answers = list(one(BENCHMARK.Laboratory(LABDATA)))
    assert answers
    wrong = [answer for answer in answers if not answer.agrees]
    assert wrong == []


def test_true_strain_of_the_silicones_is_the_logarithm_throughout():
    laboratory = BENCHMARK.Laboratory(LABDATA)
    for file in ("Ecoflex 00-50", "Dragon Skin 30"):
        path = f"silicone-d412/{file}.csv"
        nominal = laboratory.raw(path, "plain")["strain"]
        true = laboratory.raw(path, "silicone-true")["strain"]
        assert true == pytest.approx(BENCHMARK.np.log1p(nominal), abs=2e-5)
