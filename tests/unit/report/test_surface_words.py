"""Names of surfaces in both languages: every name that a configuration can make."""

import re
from itertools import product

import pytest

from nptcs.config.studies.surface import (
    GaussianProcessModel,
    LaminationModel,
    PolynomialModel,
    SpokeProcessModel,
    surface_name,
)
from nptcs.language import language
from nptcs.report.words.surfaces import surface_words

POLYNOMIALS = [
    PolynomialModel(kind="polynomial", link=link, terms=terms, choose=choose, through_origin=origin)
    for link, terms, choose, origin in product(
        ("identity", "log", "reciprocal"),
        ((), ("x", "x^2")),
        ("as_given", "aicc", "press"),
        (False, True),
    )
]
MEANS = [*POLYNOMIALS, *(LaminationModel(kind="lamination", coefficients=n) for n in (6, 7, 8))]
NAMES = [
    *map(surface_name, MEANS),
    *(
        surface_name(GaussianProcessModel(kind="gaussian_process", mean=mean))
        for mean in (None, *MEANS)
    ),
    surface_name(SpokeProcessModel(kind="spoke_process")),
]
KEPT = re.compile("AICc|PRESS")


@pytest.mark.parametrize("name", NAMES)
def test_a_name_keeps_its_english_form_and_has_no_english_word_in_chinese(name):
    assert surface_words(name) == name
    with language("zh"):
        written = surface_words(name)
    assert not re.search("[A-Za-z]", KEPT.sub("", written)), written
    assert re.findall(r"\d+", written) == re.findall(r"\d+", name)


def test_two_names_are_never_written_alike():
    with language("zh"):
        written = {surface_words(name) for name in NAMES}
    assert len(written) == len(set(NAMES))


def test_another_name_stays_as_it_is():
    with language("zh"):
        assert surface_words("my own surface") == "my own surface"
