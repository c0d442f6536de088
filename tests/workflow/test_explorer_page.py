"""The explorer of a finished run: every stored surface on the page is that of Python."""

import json
import re

import numpy as np
import pytest
from chromium import CHROMIUM, MISSING, browser

from nptcs.report.explorer.markup import asset
from nptcs.surface.registry import STIFFNESS
from nptcs.surface.stored import read_registry

AGREES = 1e-9
"""Of a value or a bound, or of the response's standard deviation where a bound is near zero."""


@pytest.mark.skipif(CHROMIUM is None, reason=MISSING)
def test_every_stored_surface_of_the_run_is_evaluated_on_the_page_as_in_python(finished, tmp_path):
    page = finished.path("results/report.html").read_text(encoding="utf-8")
    data = re.search(r'id="explorer-data">(.*?)</script>', page, re.DOTALL)
    scripts = tmp_path / "scripts.html"
    head = "<!doctype html><meta charset=utf-8><script>"
    scripts.write_text(
        f"{head}{asset('surfaces.js')}; const DATA = {data[1]};{RESTORE}</script>", "utf-8"
    )
    random, seen = np.random.default_rng(7), 0
    with browser() as tab:
        tab.open(finished.path("results/report.html").as_uri() + "#s=15")
        assert "N/mm" in tab.text("#ex-results")
        assert tab.complaints == []
        assert tab.requests == []
        tab.open(scripts.as_uri())
        for s, study in enumerate(json.loads(data[1])["studies"]):
            registry = read_registry(
                finished.path(f"results/6_surface/models/{study['name']}.json")
            )
            for fitted in registry.surfaces:
                surface = fitted.surface
                low, high = surface.x.min(axis=0), surface.x.max(axis=0)
                x = low + (high - low) * random.random((200, len(low)))
                places = json.dumps([s, fitted.solver, fitted.name, *place_of(fitted, study)])
                found = tab.value(f"({EVALUATE})({places}, {json.dumps(x.tolist())})")
                expected = np.stack([surface.predict(x), *surface.interval(x)], axis=1)
                expected[np.isinf(expected)] = np.nan
                scale = np.maximum(np.abs(expected), surface.y.std())
                error = np.abs(np.array(found, dtype=float) - expected) / scale
                assert np.nanmax(error) < AGREES, (fitted.response, fitted.name)
                seen += 1
    assert seen >= 2  # published and lca of the study of rubbers


RESTORE = "restoreCovariances(DATA.studies, DATA.covariances)"
EVALUATE = """([place, solverName, name, response, at], points) => {
  const study = DATA.studies[place];
  const solver = study.solvers.find((one) => one.name === solverName);
  const found = solver.responses.find((one) => one.name === response && one.at === at);
  const plain = found.surfaces.find((one) => one.name === name).plain;
  const columns = plain.factors.map((factor) => study.factors.indexOf(factor));
  const cases = solver.points[found.points].map((row) => columns.map((column) => row[column]));
  const surface = makeSurface(plain, cases);
  const finite = (value) => (Number.isFinite(value) ? value : null);
  return points.map((point) => [surface.predict(point), ...surface.interval(point)].map(finite));
}"""


def place_of(fitted, study):
    """Name and place of a response on the page: the study's own is its secant stiffness."""
    if fitted.response.name == STIFFNESS:
        return "secant_stiffness", f"{study['load_n']:g} N"
    return fitted.response.name, fitted.response.at
