"""What decides a study's cases: a change of anything else must not solve any case again."""

import pytest

from nptcs.config.studies.study import Study

STUDY = {
    "name": "s",
    "title": "A study",
    "factors": [{"name": "c", "label": "C", "unit": "mm", "levels": [1, 2]}],
    "solvers": ["lca"],
}


@pytest.mark.parametrize(
    ("change", "decides"),
    [
        ({"load_n": 3000.0}, True),
        ({"fixed": {"d": 1.0}}, True),
        ({"factors": [{**STUDY["factors"][0], "levels": [1, 3]}]}, True),
        ({"factors": [{**STUDY["factors"][0], "label": "Modulus", "unit": "MPa"}]}, False),
        ({"title": "The study"}, False),
        ({"solver_options": {"lca": {"points": 3}}}, False),  # each solver is given its own
        ({"terms": ["1", "c"]}, False),
        ({"neutral_line_cases": [1]}, False),
        ({"calibration_cases": {"lca": [2]}}, False),
        ({"published_coefficients": "table6.csv"}, False),
    ],
)
def test_only_what_a_solver_sees_decides_the_cases(change, decides):
    before, after = (Study(**values).case_definition() for values in (STUDY, {**STUDY, **change}))
    assert (before != after) is decides


def test_the_definition_is_itself_a_study_and_leaves_out_only_keys_that_exist():
    study = Study(**STUDY, terms=["1", "c"])
    again = Study(**study.case_definition())
    assert again.case_definition() == study.case_definition()
    assert set(Study.model_fields) >= Study.AFTERWARDS
