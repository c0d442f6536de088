"""Designs other than full factorial: known designs, brute force, whole plates."""

from itertools import combinations, product
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
import yaml
from scipy.stats import qmc

from nptcs.cli import main
from nptcs.config.solvers.tyre import TyreGeometry
from nptcs.config.studies.study import Study
from nptcs.config.studies.surface import GaussianProcessModel, PolynomialModel
from nptcs.design import build_design
from nptcs.doe.augment import augment
from nptcs.doe.d_optimal import d_optimal, log_determinant
from nptcs.doe.points import box_behnken, central_composite, space_filling
from nptcs.errors import InputError
from nptcs.surface.fit import fit
from nptcs.surface.kinds.models import FitCases, fit_surface
from nptcs.surface.registry import FittedSurface, SurfaceRegistry
from nptcs.surface.stored import dump_registry
from nptcs.surface.study import RESPONSE
from nptcs.terms import parse

ROOT = Path(__file__).parents[2]
FACTORS = [
    {"name": "spacing_mm", "label": "S", "unit": "mm", "levels": [10, 15, 20]},
    {"name": "thickness_mm", "label": "T", "unit": "mm", "levels": [1.2, 1.8, 2.4]},
    {"name": "angle_deg", "label": "A", "unit": "deg", "levels": [0, 45, 90]},
]
TERMS = ["1", "spacing_mm", "thickness_mm", "angle_deg", "angle_deg^2"]
THROUGH_ORIGIN = {"kind": "polynomial", "through_origin": True}
KINDS = {
    "latin_hypercube": {"cases": 17},
    "sobol": {"cases": 16},
    "central_composite": {},
    "box_behnken": {"centre_cases": 2},
    "d_optimal": {"cases": 9, "terms": TERMS},
    "full_factorial": {},
}


def study(design, factors=FACTORS, **changes):
    values = {"name": "s", "title": "t", "factors": factors, "solvers": ["fe_tyre"]}
    return Study.model_validate({**values, "design": design, **changes})


@pytest.mark.parametrize("kind", KINDS)
def test_each_kind_gives_the_stated_number_of_cases_inside_the_box(kind):
    chosen = study({"kind": kind, **KINDS[kind]})
    table = build_design(chosen, {}, TyreGeometry())

    assert len(table) == chosen.number_of_cases()
    assert table["case_id"].is_unique
    assert table["spacing_mm"].between(10, 20).all()
    assert table["thickness_mm"].between(1.2, 2.4).all()
    assert table["angle_deg"].between(0, 90).all()
    again = build_design(chosen, {}, TyreGeometry())
    pd.testing.assert_frame_equal(table, again)


@pytest.mark.parametrize("kind", ["latin_hypercube", "sobol", "central_composite", "d_optimal"])
def test_whole_plates_are_whole(kind):
    tyre = TyreGeometry()
    table = build_design(study({"kind": kind, "whole_plates": True, **KINDS[kind]}), {}, tyre)
    plates = tyre.tread_width_mm / table["spacing_mm"]
    np.testing.assert_allclose(plates, plates.round(), atol=1e-9)
    counted = [tyre.plates_across(spacing) for spacing in table["spacing_mm"]]
    assert counted == plates.round().astype(int).tolist()


def test_a_latin_hypercube_has_one_case_in_each_slice_and_covers_the_box_evenly():
    points = (space_filling("latin_hypercube", 40, 3, 1) + 1) / 2
    for axis in range(3):
        assert sorted((points[:, axis] * 40).astype(int)) == list(range(40))
    random = np.random.default_rng(1).random((40, 3))
    assert qmc.discrepancy(points) < 0.5 * qmc.discrepancy(random)


def test_central_composite_and_box_behnken_are_the_known_ones():
    face = central_composite(3, "face", 1)
    assert len(face) == 8 + 6 + 1
    assert set(np.unique(face)) == {-1, 0, 1}
    inscribed = central_composite(2, "inscribed", 3)
    np.testing.assert_allclose(np.abs(inscribed[:4]), 2**-0.5)
    # rotatable: all but the centre lie on one circle
    np.testing.assert_allclose(np.linalg.norm(inscribed[:8], axis=1), 1)
    bbd = box_behnken(3, 3)
    assert len(bbd) == 15
    np.testing.assert_allclose(np.abs(bbd[:12]).sum(axis=1), 2)
    assert len({tuple(point) for point in bbd}) == 13
    with pytest.raises(InputError, match="three to five"):
        box_behnken(2, 1)


@pytest.mark.parametrize("cases", [6, 7])
def test_d_optimal_is_the_best_of_all_choices(cases):
    points = pd.DataFrame(list(product([-1.0, 0.0, 1.0], repeat=2)), columns=["a", "b"])
    terms = parse(["1", "a", "b", "a*b", "a^2", "b^2"], ["a", "b"])
    matrix = terms.matrix(points.to_numpy())
    best = max(log_determinant(matrix[list(c)]) for c in combinations(range(9), cases))

    chosen = d_optimal(matrix, cases, 20, 1)

    assert log_determinant(matrix[chosen]) == pytest.approx(best, abs=1e-9)
    assert len(set(chosen)) == cases


def test_d_optimal_for_a_plane_takes_the_corners():
    points = np.array(list(product([-1.0, 0.0, 1.0], repeat=3)))
    matrix = np.column_stack([np.ones(27), points])
    chosen = d_optimal(matrix, 8, 10, 1)
    assert (np.abs(points[chosen]) == 1).all()
    # D-efficiency, det(XᵀX)^(1/p) / m, is 1 for an orthogonal design in the corners
    efficiency = np.exp(log_determinant(matrix[chosen]) / 4) / 8
    assert efficiency == pytest.approx(1)


def test_d_optimal_with_mixed_levels_determines_the_papers_terms():
    terms = list(
        pd.read_csv(
            ROOT / "raw_data" / "published" / "table6_plate_coefficients.csv", dtype={"term": str}
        )["term"]
    )
    factors = [*FACTORS[:2], {**FACTORS[2], "levels": [0, 15, 30, 45, 60, 75, 90]}]
    chosen = study({"kind": "d_optimal", "cases": 16, "terms": terms}, factors)
    table = build_design(chosen, {}, TyreGeometry())
    response = pd.Series(np.random.default_rng(1).normal(size=16))
    surface = fit(table, response, ["spacing_mm", "thickness_mm", "angle_deg"], terms)
    assert surface.coefficients == 11


def test_what_a_design_refuses():
    rubber = [
        {"name": "c", "label": "c", "unit": "MPa", "levels": [{"rubber": "r"}, {"rubber": "q"}]}
    ]
    for design, factors, match in (
        ({"kind": "latin_hypercube", "cases": 5}, rubber, "tested rubbers do not have"),
        ({"kind": "sobol", "cases": 4, "whole_plates": True}, FACTORS[1:], "not a factor"),
        ({"kind": "d_optimal", "cases": 4, "terms": TERMS}, FACTORS, "needs at least 5"),
        (
            {"kind": "d_optimal", "cases": 9, "terms": [*TERMS, "angle_deg^3"]},
            FACTORS,
            "cannot determine",
        ),
    ):
        with pytest.raises(InputError, match=match):
            build_design(study(design, factors), {"r": 1.0, "q": 2.0}, TyreGeometry())


def test_named_cases_must_exist_in_the_design():
    with pytest.raises(ValueError, match="not among cases 1 to 17"):
        study({"kind": "latin_hypercube", "cases": 17}, neutral_line_cases=[18])


def test_further_cases_go_where_the_surface_is_least_sure():
    x = np.array([[0.0], [0.1], [0.2], [0.3], [1.0]])
    cases = FitCases(x, np.sin(3 * x[:, 0]), ("x",), [])
    surface = fit_surface(GaussianProcessModel(kind="gaussian_process"), cases)
    candidates = np.linspace(0, 1, 101)[:, None]

    points, half_widths = augment(surface, candidates, 3)

    assert 0.5 < points[0, 0] < 0.9
    assert half_widths[0] > half_widths[1]
    assert len({round(point, 3) for point in points[:, 0]}) == 3
    with pytest.raises(InputError, match="only 0 candidates"):
        augment(surface, x, 1)


def test_further_cases_follow_the_design_and_are_complete():
    further = [{"angle_deg": 30.0, "spacing_mm": 12.0, "thickness_mm": 2.0}]
    chosen = study({"kind": "central_composite"}, further_cases=further)
    table = build_design(chosen, {}, TyreGeometry())
    assert len(table) == chosen.number_of_cases() == 16
    assert table.iloc[-1][["case_id", "spacing_mm", "angle_deg"]].tolist() == ["s_016", 12.0, 30.0]
    with pytest.raises(ValueError, match="further_cases, case 1"):
        study({"kind": "central_composite"}, further_cases=[{"spacing_mm": 12.0}])


def test_terms_that_cannot_be_read_are_found_with_the_configuration():
    for changes in (
        {"terms": ["1", "width_mm"]},
        {"terms": ["1"], "surfaces": [{"kind": "polynomial", "terms": ["1", "angle_deg^2"]}]},
        {"terms": ["1"], "surfaces": [{**THROUGH_ORIGIN, "terms": ["1"]}]},
    ):
        with pytest.raises(ValueError, match="terms"):
            study({"kind": "full_factorial"}, **changes)


def test_augment_prints_cases_for_the_study(tmp_path, capsys):
    table = build_design(study({"kind": "central_composite"}), {}, TyreGeometry())
    x = table[["spacing_mm", "thickness_mm", "angle_deg"]].to_numpy()
    cases = FitCases(x, x[:, 0] * 2 + x[:, 1] ** 2, tuple(table)[2:5], TERMS[:4])
    surface = fit_surface(PolynomialModel(kind="polynomial"), cases)
    fitted = FittedSurface("s", "lca", "polynomial", RESPONSE, surface)
    (tmp_path / "s.json").write_text(dump_registry(SurfaceRegistry("s", (fitted,))))
    command = ["augment", "s", "--models", str(tmp_path), "--cases", "2", "--solver"]

    assert main([*command, "lca"]) == 0
    printed = capsys.readouterr().out
    further = yaml.safe_load(printed)["further_cases"]
    assert study({"kind": "full_factorial"}, further_cases=further).number_of_cases() == 29
    assert "95 % interval ±" in printed
    assert main([*command, "fe_tyre"]) == 2
    assert "no surface for this solver" in capsys.readouterr().err
