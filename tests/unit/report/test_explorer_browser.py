"""The explorer in a real browser: its numbers against Python, keys, touch, address, no request."""

import json
from dataclasses import replace
from importlib import resources

import numpy as np
import pandas as pd
import pytest
from axe_check import chromium, violations
from chromium import CHROMIUM, MISSING, Tab

from nptcs import lca
from nptcs.config.solvers.tyre import TyreGeometry
from nptcs.config.studies.surface import (
    GaussianProcessModel,
    LaminationModel,
    PolynomialModel,
    SpokeProcessModel,
    surface_name,
)
from nptcs.doe.split_plot import split_plot
from nptcs.lca.spokes.stiffness_table import SpokeStiffnessTable
from nptcs.report.data import LcaRing, SolverDescription
from nptcs.report.explorer.markup import asset, explorer_markup
from nptcs.report.explorer.models import plain_surface
from nptcs.report.explorer.payload import explorer_payload
from nptcs.surface.kinds.models import FitCases, fit_surface
from nptcs.surface.registry import FittedSurface, Response, SurfaceRegistry
from nptcs.tables.laboratory.material_card import PUBLISHED_PLY

pytestmark = pytest.mark.skipif(CHROMIUM is None, reason=MISSING)

TOLERANCE = 1e-9
POINTS = 200
LAMINATION = LaminationModel(kind="lamination", coefficients=7)
MODELS = {
    "plate": [
        PolynomialModel(kind="polynomial"),
        PolynomialModel(kind="polynomial", link="log"),
        PolynomialModel(kind="polynomial", link="reciprocal"),
        LAMINATION,
        GaussianProcessModel(kind="gaussian_process"),
        GaussianProcessModel(kind="gaussian_process", mean=LAMINATION),
    ],
    "rubber": [
        PolynomialModel(kind="polynomial"),
        GaussianProcessModel(kind="gaussian_process", mean=PolynomialModel(kind="polynomial")),
    ],
}
LOADS = {3000.0: 1.04, 5000.0: 1.0}
"""Made-up ratio of the stiffness at a load to that of the table."""


def fitted(study, cases):
    """Surfaces of a study's published stiffness at two loads, and of a second response."""
    names = [factor.name for factor in study.factors]
    rows = cases[cases["study"] == study.name]
    x, k = rows[names].to_numpy(float), rows["vertical_stiffness_n_per_mm"].to_numpy(float)
    values = {Response.stiffness(load): ratio * k for load, ratio in LOADS.items()}
    values[Response("plate_mass", "", "kg")] = 0.5 + x[:, 0] / 30 + x[:, 1] ** 2 / 10
    for response, y in values.items():
        for model in MODELS[study.name]:
            if response.unit == "N/mm" or not isinstance(model, LaminationModel):
                if getattr(model, "mean", None) is LAMINATION and response.unit != "N/mm":
                    continue
                surface = fit_surface(model, FitCases(x, y, names, study.terms, PUBLISHED_PLY))
                yield FittedSurface(
                    study.name,
                    "published",
                    surface_name(model),
                    response,
                    surface,
                    left_out_rms=1.0,
                )


@pytest.fixture(scope="module")
def explored(results):
    """The run written by hand, with stored surfaces, whole plates and the load-bearing model."""
    cases = results.tables["cases.csv"]
    models = {
        study.name: SurfaceRegistry(study.name, tuple(fitted(study, cases)))
        for study in results.config.studies
    }
    spokes = pd.read_csv("raw_data/published/table10_spoke_stiffness.csv").to_dict("records")
    return replace(
        results,
        models=models,
        solvers={"published": SolverDescription("published", False, True, whole_plates=True)},
        lca_ring=LcaRing("sandwich", "table10.csv", spokes),
    )


@pytest.fixture(scope="module")
def payload(explored):
    return json.loads(json.dumps(explorer_payload(explored), allow_nan=False))


@pytest.fixture(scope="module")
def started():
    with chromium() as browser:
        yield browser


@pytest.fixture(scope="module")
def tab(started):
    return Tab(started)


@pytest.fixture(scope="module")
def address(payload, tmp_path_factory):
    page = tmp_path_factory.mktemp("page") / "page.html"
    markup = explorer_markup(payload, "needs scripts")
    head = '<!doctype html><html lang="en"><meta charset="utf-8"><title>t</title><main>'
    head += "<h1>Report</h1><h2>Explore</h2>"
    style = resources.files("nptcs.report").joinpath("templates", "report.css").read_text("utf-8")
    head += f"<style>{style}</style>"
    head += '<meta name="viewport" content="width=device-width, initial-scale=1">'
    page.write_text(f"{head}{markup}</main></html>", encoding="utf-8")
    return page.as_uri()


@pytest.fixture(scope="module")
def functions(tab, tmp_path_factory):
    """A page that has the functions only; returns how to open it."""
    page = tmp_path_factory.mktemp("functions") / "page.html"
    scripts = asset("surfaces.js") + asset("lca.js") + asset("wheel.js")
    page.write_text(f"<!doctype html><meta charset=utf-8><script>{scripts}</script>", "utf-8")
    return lambda: tab.open(page.as_uri())


def spoke_surface():
    low, high = np.array([10.0, 1.2, 0.0, 4.0, 1.0]), np.array([20.0, 2.4, 90.0, 6.0, 5.0])
    coded = split_plot(4, 1, 40, 5, corners=True, seed=1)[:, [0, 1, 2, 4, 3]]
    x = (low + high) / 2 + coded * (high - low) / 2
    plates = np.cos(np.radians(x[:, 2])) ** 4 * x[:, 1] ** 3 / x[:, 0]
    y = 200 * x[:, 3] ** 0.4 * x[:, 4] ** 0.5 * (1 + 0.1 * np.log1p(plates)) / x[:, 0] ** 0.2
    names = ("spacing_mm", "thickness_mm", "angle_deg", "shear_band_c10_mpa", "spoke_c10_mpa")
    model = SpokeProcessModel(kind="spoke_process", degree=3)
    return fit_surface(model, FitCases(x, y, names, (), PUBLISHED_PLY))


def difference(tab, surface):
    """Largest relative difference of the values, and of the bounds' squared distances from them.

    What is near zero is compared with the standard deviation of the response over the cases. Both
    compute a variance, which at a case is zero up to rounding: comparing the bounds would compare
    the root of that rounding.
    """
    low, high = surface.x.min(axis=0), surface.x.max(axis=0)
    x = low + (high - low) * np.random.default_rng(12).random((POINTS, len(low)))
    x[:5] = surface.x[:5]
    tab.value(
        f"globalThis.surface = makeSurface({json.dumps(plain_surface(surface))}, "
        f"{json.dumps(surface.x.tolist())}); 0"
    )
    found = tab.value(
        f"{json.dumps(x.tolist())}.map((p) => [surface.predict(p), ...surface.interval(p)]"
        ".map((v) => (v === Infinity ? null : v)))"
    )
    computed = np.array(found, dtype=float)
    expected = np.stack([surface.predict(x), *surface.interval(x)], axis=1)
    expected[np.isinf(expected)] = np.nan
    assert (np.isnan(computed) == np.isnan(expected)).all()
    sd = surface.y.std()
    values = np.abs(computed[:, 0] - expected[:, 0]) / np.maximum(np.abs(expected[:, 0]), sd)
    ours, theirs = squares_of_offsets(expected), squares_of_offsets(computed)
    spreads = np.abs(theirs - ours) / np.maximum(np.abs(ours), sd**2)
    return np.nanmax(np.column_stack([values, spreads]))


def squares_of_offsets(found):
    """Squared distances of the bounds from the value, with their signs."""
    offset = found[:, 1:] - found[:, :1]
    return np.sign(offset) * offset**2


def test_every_kind_of_surface_agrees_with_python(explored, tab, functions):
    functions()
    surfaces = {
        f"{f.study} {f.response} {f.name}": f.surface
        for registry in explored.models.values()
        for f in registry.surfaces
    }
    surfaces["spoke process"] = spoke_surface()
    found = {name: difference(tab, surface) for name, surface in surfaces.items()}
    assert max(found.values()) < TOLERANCE, max(found.items(), key=lambda item: item[1])
    assert len(found) == 6 + 6 + 4 + 2 + 2 + 2 + 1


def test_the_ring_is_that_of_the_load_bearing_model(payload, tab, functions):
    functions()
    tyre = TyreGeometry()
    table = SpokeStiffnessTable.from_rows(
        pd.read_csv("raw_data/published/table10_spoke_stiffness.csv").to_dict("records")
    )
    degrees = np.arange(-180.0, 181.0, 7.5)
    for band, spoke, load in [(5.0, 1.0, 5000.0), (4.2, 3.3, 9000.0), (6.0, 4.9, 700.0)]:
        ring = lca.ShearBandSection.from_tyre(tyre, band)
        state = lca.solve(ring, table.spokes(spoke, tyre.spoke_count), load_n=load)
        found = tab.value(
            f"(() => {{ const w = wheelOf({json.dumps(payload['ring'])}, {band}, {spoke});"
            f"const s = solveWheel(w, {load});"
            f"return [s.displacement, s.contactLength, s.thetaT * 180 / Math.PI, "
            f"displacementsAt(s, {np.radians(degrees).tolist()})]; }})()"
        )
        exact = [state.displacement_mm, state.contact_length_mm, state.theta_t_deg]
        assert found[:3] == pytest.approx(exact, rel=TOLERANCE)
        at = state.at(degrees)[["u_r_mm", "u_theta_mm"]].to_numpy()
        assert np.array(found[3]) == pytest.approx(at, abs=TOLERANCE * state.displacement_mm)


def test_the_scaled_spokes_give_the_asked_displacement(payload, tab, functions):
    functions()
    wheel = f"wheelOf({json.dumps(payload['ring'])}, 5, 1.04)"
    found = tab.value(
        f"[12, 18.6, 24].map((d) => wheelWithDisplacement({wheel}, 5000, d).displacement)"
    )
    assert found == pytest.approx([12, 18.6, 24], rel=1e-9)


def value_of(tab, row):
    return tab.text(f'[data-row="{row}"] .ex-value')


def test_the_page_shows_the_value_of_the_model_and_asks_for_nothing(explored, tab, address):
    tab.open(address + "#s=12&t=2&a=30&study=plate&model=lamination%207&load=3000")
    stiffness = next(
        f.surface
        for f in explored.models["plate"].surfaces
        if f.name == "lamination 7" and f.response.at == "3000 N"
    )
    plates = TyreGeometry().plates_across(12.0)
    expected = stiffness.predict(np.array([[215.0 / plates, 2.0, 30.0]]))[0]
    shown = float(value_of(tab, "secant_stiffness@3000 N").split()[0])
    assert shown == pytest.approx(expected, rel=1e-3)
    displacement = float(value_of(tab, "displacement").split()[0])
    assert displacement == pytest.approx(3000 / expected, rel=1e-3)
    assert f"{plates} plates at a pitch of {215 / plates:.3f} mm" in tab.text("#ex-plates")
    assert tab.complaints == []
    assert tab.requests == []


def test_outside_the_cases_there_is_a_warning_and_no_number_where_a_model_is_refused(tab, address):
    tab.open(address + "#s=15&t=2.6&a=45&model=gaussian%20process%20on%20the%20mean")
    assert "plate thickness T 2.6 mm (cases 1.2 to 2.4)" in tab.text("#ex-warning")
    assert value_of(tab, "secant_stiffness@5000 N") == "–"
    assert value_of(tab, "displacement") == "–"
    tab.open(address + "#s=15&t=2.6&a=45&model=lamination%207")
    assert value_of(tab, "secant_stiffness@5000 N").endswith("N/mm")
    row = tab.text('[data-row="secant_stiffness@5000 N"]')
    assert "value without an interval" in row
    assert tab.complaints == []


def test_the_state_goes_into_the_address_and_is_restored(tab, address):
    state = "#s=12.5&t=2.1&a=33&load=3000&study=plate&solver=published&model=polynomial%20of%20log"
    state += "&band=250..270&x=a&y=t&shown=plate_mass%40&turn=-40&tilt=50"
    tab.open(address + state)
    first = tab.text("#ex-results")
    tab.value("document.querySelector('[data-factor=t] input[type=number]').focus()")
    tab.press("ArrowUp", "ArrowDown", "Enter")
    assert tab.value("location.hash") == state
    tab.open(tab.value("location.href"))
    assert tab.text("#ex-results") == first
    assert tab.value("document.getElementById('ex-across').value") == "angle_deg"
    assert tab.value("document.getElementById('ex-turn').value") == "-40"


def test_an_address_with_nonsense_gives_the_reference_design(tab, address):
    tab.open(address + "#s=-3&t=x&study=none&model=%&band=9..1&x=q&tilt=900&load=77")
    assert tab.value("document.querySelector('[data-factor=s] input[type=number]').value") == "15"
    assert tab.complaints == []
    tab.open(address + "#specimens")
    assert tab.value("location.hash") == "#specimens"


def test_the_keyboard_alone_moves_sliders_and_copies_commands(tab, address):
    tab.open(address + "#s=15&t=1.8&a=45")
    for _ in range(40):
        tab.press("Tab")
        label = tab.value("document.activeElement.getAttribute('aria-label')")
        if label == "fibre angle A, slider":
            break
    assert label == "fibre angle A, slider"
    before = value_of(tab, "secant_stiffness@5000 N")
    tab.press(*["ArrowRight"] * 10)
    assert "a=55" in tab.value("location.hash")
    assert value_of(tab, "secant_stiffness@5000 N") != before
    for _ in range(40):
        tab.press("Tab")
        if tab.value("document.activeElement.id") == "ex-copy_judge":
            break
    tab.press("Enter")
    command = tab.value("document.getElementById('ex-text').value")
    assert command.startswith("nptcs design --study plate --solver published --surface ")
    assert command.endswith("--hold spacing_mm=15 --hold thickness_mm=1.8 --hold angle_deg=55")
    assert tab.complaints == []


def test_a_finger_on_a_profile_sets_the_factor_on_a_phone(started, address):
    phone = Tab(started, 390)
    phone.open(address + "#s=15&t=1.8&a=45")
    assert phone.value("document.documentElement.scrollWidth") <= 390
    phone.value("document.querySelectorAll('.ex-profile')[2].scrollIntoView({block: 'center'})")
    place = phone.value(
        "(() => { const b = document.querySelectorAll('.ex-profile')[2]"
        ".getBoundingClientRect(); return [b.right - 12, b.top + b.height / 2]; })()"
    )
    phone.touch(*place)
    angle = float(phone.value("new URLSearchParams(location.hash.slice(1)).get('a')"))
    assert angle > 80
    phone.close()


def test_factors_that_a_study_holds_cannot_be_moved(tab, address):
    tab.open(address + "#study=rubber")
    slider = "document.querySelector('[data-factor=s] input[type=range]').disabled"
    assert tab.value(slider) is True
    assert "Held at 15 mm in this study" in tab.text("#ex-note-s")
    tab.open(address + "#study=plate")
    assert tab.value(slider) is False
    assert "Held at 5 MPa" in tab.text("#ex-note-tc")


@pytest.mark.parametrize("dark", [False, True])
@pytest.mark.parametrize("width", [390, 1280])
def test_axe_finds_no_barrier_on_any_screen_in_any_light(started, address, width, dark):
    screen = Tab(started, width, dark=dark)
    screen.open(address + "#t=2.7&model=lamination%207")
    assert violations(screen.page) == []
    paper = "getComputedStyle(document.getElementById('explorer')).getPropertyValue('--ex-paper')"
    assert screen.value(paper).strip() == ("#15181b" if dark else "#ffffff")
    screen.close()
