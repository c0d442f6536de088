"""Surfaces of several responses: what is fitted, left out, ranked, stored and predicted."""

import numpy as np
import pandas as pd
import pytest

from nptcs.config.studies.response import ResponseChoice
from nptcs.config.studies.sensitivity import Sensitivity
from nptcs.config.studies.study import Study
from nptcs.errors import InputError
from nptcs.surface.registry import Response
from nptcs.surface.sensitivity.response_tables import (
    mean_slopes,
    response_impacts,
    response_surfaces,
)
from nptcs.surface.stored import dump_registry, load_registry
from nptcs.surface.study import RESPONSE, fit_study, responses_of
from nptcs.tables.analysis.response_surfaces import ResponseImpact, ResponseSurfaces
from nptcs.tables.io import check

MASS = Response("plate_mass")
SOFTER = Response("secant_stiffness", "3000 N", "N/mm")
POINT = pd.DataFrame({"spacing_mm": [12.0], "thickness_mm": [2.0], "comment": ["kept out"]})


def study(**changes):
    factors = [
        {"name": "spacing_mm", "label": "S", "unit": "mm", "levels": [10, 15, 20]},
        {"name": "thickness_mm", "label": "T", "unit": "mm", "levels": [1.2, 1.8, 2.4]},
    ]
    return Study.model_validate(
        {
            "name": "plate",
            "title": "",
            "factors": factors,
            "solvers": ["lca"],
            "terms": ["1", "spacing_mm", "thickness_mm"],
            "responses": ["plate_mass", {"name": "secant_stiffness", "load_n": 3000}],
            **changes,
        }
    )


def cases():
    places = [(s, t) for s in (10.0, 15.0, 20.0) for t in (1.2, 1.8, 2.4)]
    table = pd.DataFrame(places, columns=["spacing_mm", "thickness_mm"])
    table["vertical_stiffness_n_per_mm"] = 400 - 5 * table["spacing_mm"] + 8 * table["thickness_mm"]
    ids = [f"plate_{number}" for number in range(len(table))]
    return table.assign(case_id=ids, solver="lca", status="ok", study="plate")


def values(lacking=()):
    """Mass = 3 T - 0.1 S; the stiffness at 3000 N is 10 N/mm below that at 5000 N."""
    solved, rows = cases(), []
    for number, case in solved.iterrows():
        mass = 3 * case["thickness_mm"] - 0.1 * case["spacing_mm"]
        rows.append((case["case_id"], "plate_mass", "", np.nan if number in lacking else mass))
        soft = case["vertical_stiffness_n_per_mm"] - 10
        rows.append((case["case_id"], "secant_stiffness", "3000 N", soft))
        rows.append((case["case_id"], "secant_stiffness", "5000 N", soft + 10))
    table = pd.DataFrame(rows, columns=["case_id", "response", "at", "value"])
    return table.assign(solver="lca")


def test_every_response_has_its_own_surface():
    registry = fit_study(cases(), study(), values=values()).registry()
    assert registry.responses() == [RESPONSE, Response("plate_mass", "", "kg"), SOFTER]
    at = {str(r): registry.find(r).predict(POINT).mean[0] for r in registry.responses()}
    assert at["plate_mass"] == pytest.approx(3 * 2 - 1.2)
    assert at["secant_stiffness at 3000 N"] == pytest.approx(346)
    assert at[str(RESPONSE)] == pytest.approx(356)


def test_the_stiffness_of_tables_6_and_8_does_not_depend_on_further_responses():
    alone = fit_study(cases(), study(responses=())).polynomials["lca"]
    with_others = fit_study(cases(), study(), values=values()).polynomials["lca"]
    np.testing.assert_allclose(
        alone.coefficients_natural, with_others.coefficients_natural, rtol=1e-12
    )


def test_cases_without_a_response_are_left_out_and_counted():
    done = fit_study(cases(), study(), values=values(lacking=(0, 5)))
    table = check(response_surfaces(done), ResponseSurfaces, "r").set_index("response")
    assert table["points"].to_dict() == {RESPONSE.name: 9, "plate_mass": 7, "secant_stiffness": 9}
    assert table.loc["plate_mass", "not_assessed_cases"] == 2
    assert done.registry().find(MASS).not_assessed == 2


def test_a_response_that_no_case_has_is_named():
    done = fit_study(cases(), study(), values=values(lacking=range(9)))
    assert RESPONSE in done.registry().responses()
    (row,) = done.problems.itertuples()
    assert row.solver == "lca, plate_mass"
    assert "9 without this response" in row.message


def test_a_solver_without_a_response_that_another_has_is_not_a_problem():
    archive = cases().assign(solver="published")
    both = pd.concat([cases(), archive], ignore_index=True)
    done = fit_study(both, study(solvers=["lca", "published"]), values=values())
    assert len(done.problems) == 0
    assert done.registry().responses("published") == [RESPONSE]


def test_the_standard_error_is_not_assessed_outside_the_box():
    fitted = fit_study(cases(), study(), values=values()).registry().find(SOFTER)
    found = fitted.predict(np.array([[12.0, 2.0], [25.0, 2.0]]))
    assert found.inside.tolist() == [True, False]
    assert np.isfinite(found.standard_error).tolist() == [True, False]


def test_a_point_without_a_factor_is_refused():
    fitted = fit_study(cases(), study()).registry().find(RESPONSE)
    with pytest.raises(InputError, match="thickness_mm"):
        fitted.predict(POINT[["spacing_mm"]])
    with pytest.raises(InputError, match="number"):
        fitted.predict(np.array([[12.0, np.nan]]))


def test_a_registry_is_read_back_unchanged():
    registry = fit_study(cases(), study(), values=values(lacking=(3,))).registry()
    again = load_registry(dump_registry(registry))
    assert again.study == "plate"
    for old, new in zip(registry.surfaces, again.surfaces, strict=True):
        assert (old.response, old.not_assessed) == (new.response, new.not_assessed)
        assert new.left_out_rms == pytest.approx(old.left_out_rms, nan_ok=True)
        np.testing.assert_allclose(new.predict(POINT).mean, old.predict(POINT).mean, rtol=1e-12)


def test_a_missing_response_is_refused_with_those_that_exist():
    registry = fit_study(cases(), study(), values=values()).registry()
    with pytest.raises(InputError, match="plate_mass, secant_stiffness at 3000 N"):
        registry.find(Response("contact_length", "5000 N"))


def test_factors_are_ranked_for_each_response():
    registry = fit_study(cases(), study(), values=values()).registry()
    table = check(response_impacts([registry], Sensitivity()).table, ResponseImpact, "i")
    rows = table.set_index(["response", "factor"])
    assert rows.loc[("plate_mass", "thickness_mm"), "rank"] == 1
    assert rows.loc[("secant_stiffness", "spacing_mm"), "rank"] == 1
    # the slope of a plane × range
    assert rows.loc[("plate_mass", "thickness_mm"), "impact"] == pytest.approx(3.6)
    assert rows.loc[("plate_mass", "spacing_mm"), "signed_impact"] == pytest.approx(-1)
    # variances of uniform factors: (slope × range)²/12
    assert rows.loc[("plate_mass", "thickness_mm"), "total_index"] == pytest.approx(
        3.6**2 / (3.6**2 + 1), abs=0.02
    )


def test_mean_slopes_are_those_of_the_polynomial():
    fitted = fit_study(cases(), study()).registry().find(RESPONSE)
    size, signed = mean_slopes(fitted, seed=1)
    np.testing.assert_allclose(size, [50, 9.6], rtol=1e-9)
    np.testing.assert_allclose(signed, [-50, 9.6], rtol=1e-9)


@pytest.mark.parametrize(
    ("choice", "words"),
    [
        ("plate_weight", "unknown response"),
        ({"name": "plate_mass", "load_n": 3000}, "leave load_n"),
        ({"name": "secant_stiffness", "load_n": 3000, "displacement_mm": 25}, "not both"),
    ],
)
def test_a_response_that_cannot_be_taken_is_refused(choice, words):
    with pytest.raises(ValueError, match=words):
        ResponseChoice.model_validate(choice)


def test_responses_are_taken_at_the_study_load_unless_another_is_given():
    chosen = study(
        responses=["contact_length", {"name": "tangent_stiffness", "displacement_mm": 25}]
    )
    assert [str(r) for r in responses_of(chosen)] == [
        "contact_length at 5000 N",
        "tangent_stiffness at 25 mm",
    ]
    with pytest.raises(ValueError, match="named twice"):
        study(responses=["secant_stiffness", {"name": "secant_stiffness", "load_n": 5000}])
