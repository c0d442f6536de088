"""A sealed text is opened unchanged; any other text is refused."""

import json

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from nptcs.seal import SEAL, BrokenSealError, open_lines, open_object, sealed_lines, sealed_object

PLAIN = st.recursive(
    st.none()
    | st.booleans()
    | st.integers()
    | st.floats(allow_nan=False, allow_infinity=False)
    | st.text(),
    lambda inner: st.lists(inner) | st.dictionaries(st.text(), inner),
    max_leaves=10,
)
OBJECTS = st.dictionaries(st.text().filter(lambda key: key != SEAL), PLAIN)
ROWS = OBJECTS.map(lambda content: json.dumps(content, ensure_ascii=False))


@settings(max_examples=40, deadline=None)
@given(OBJECTS)
def test_a_sealed_object_is_opened_unchanged(content):
    assert open_object(sealed_object(content, "Surfaces"), "Surfaces") == content


@settings(max_examples=40, deadline=None)
@given(OBJECTS.filter(bool), st.data())
def test_an_object_with_a_changed_value_is_refused(content, data):
    stored = json.loads(sealed_object(content, "Surfaces"))
    key = data.draw(st.sampled_from(sorted(content)))
    other = data.draw(PLAIN.filter(lambda value: json.dumps(value) != json.dumps(stored[key])))
    stored[key] = other
    # the order of the keys of a mapping does not matter
    if json.dumps(other, sort_keys=True) != json.dumps(content[key], sort_keys=True):
        with pytest.raises(BrokenSealError, match="checksum"):
            open_object(json.dumps(stored), "Surfaces")


@settings(max_examples=40, deadline=None)
@given(st.lists(ROWS))
def test_sealed_lines_are_opened_unchanged(rows):
    assert open_lines(sealed_lines(rows, "CaseRecords"), "CaseRecords") == rows


@settings(max_examples=40, deadline=None)
@given(st.lists(ROWS), st.data())
def test_lines_that_were_cut_off_are_refused(rows, data):
    text = sealed_lines(rows, "CaseRecords").rstrip("\n")
    end = data.draw(st.integers(0, len(text) - 1))
    with pytest.raises(BrokenSealError):
        open_lines(text[:end], "CaseRecords")


def test_one_format_is_not_taken_for_another():
    with pytest.raises(BrokenSealError, match="has format PlyCard 1, not RubberCard 1"):
        open_object(sealed_object({"a": 1}, "PlyCard"), "RubberCard")


def test_a_number_that_is_not_finite_cannot_be_sealed():
    with pytest.raises(ValueError, match="not JSON compliant"):
        sealed_object({"a": float("nan")}, "Surfaces")
