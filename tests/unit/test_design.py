"""Design tables against tables 5 and 7 of the paper, and the errors of a faulty study."""

from itertools import product
from pathlib import Path

import pandas as pd
import pytest
import yaml
from hypothesis import given
from hypothesis import strategies as st

from nptcs.config.studies.study import Study
from nptcs.design import full_factorial
from nptcs.errors import InputError

ROOT = Path(__file__).parents[2]


def study(**changes):
    values = {
        "name": "s",
        "title": "t",
        "factors": [
            {"name": "a", "label": "a", "unit": "mm", "levels": [1, 2]},
            {"name": "b", "label": "b", "unit": "mm", "levels": [10, 20, 30]},
        ],
        "solvers": ["lca"],
        "terms": ["1"],
    }
    return Study.model_validate({**values, **changes})


@pytest.mark.parametrize(
    ("name", "table"),
    [("plate", "table5_plate_doe.csv"), ("rubber", "table7_rubber_doe.csv")],
)
def test_default_studies_are_numbered_as_the_published_tables(name, table):
    config = yaml.safe_load((ROOT / "config" / "config.yaml").read_text())
    chosen = next(study for study in config["studies"] if study["name"] == name)

    design = full_factorial(Study.model_validate(chosen), {})

    published = pd.read_csv(ROOT / "raw_data" / "published" / table)
    factors = [factor["name"] for factor in chosen["factors"]]
    pd.testing.assert_frame_equal(
        design[["case", *factors]], published[["case", *factors]], check_dtype=False
    )
    assert design["case_id"].iloc[-1] == f"{name}_{len(published):03d}"


def test_fixed_values_and_tested_rubbers_become_columns():
    table = full_factorial(
        study(fixed={"c": 3, "spoke_c10_mpa": {"rubber": "rubber_75A"}}), {"rubber_75A": 1.18}
    )
    assert list(table) == ["case_id", "case", "a", "b", "c", "spoke_c10_mpa"]
    assert set(table["spoke_c10_mpa"]) == {1.18}
    assert list(table["b"])[:4] == [10, 20, 30, 10]


def test_a_rubber_without_a_card_and_equal_levels_are_named():
    with pytest.raises(InputError, match="no material card") as refusal:
        full_factorial(study(fixed={"c": {"rubber": "rubber_60A"}}), {"rubber_75A": 1.0})
    assert "rubber_60A" in str(refusal.value)
    assert "known: rubber_75A" in str(refusal.value)
    levels = [{"rubber": "r1"}, {"rubber": "r2"}]
    factor = {"name": "a", "label": "a", "unit": "MPa", "levels": levels}
    with pytest.raises(InputError, match="two levels of a have the same value"):
        full_factorial(study(factors=[factor]), {"r1": 2.0, "r2": 2.0})


@given(
    st.lists(
        st.lists(st.floats(-1e6, 1e6), min_size=2, max_size=4, unique=True).map(sorted),
        min_size=1,
        max_size=4,
    )
)
def test_every_combination_appears_once(levels):
    factors = [
        {"name": f"f{i}", "label": "f", "unit": "mm", "levels": values}
        for i, values in enumerate(levels)
    ]
    table = full_factorial(study(factors=factors), {})
    found = list(table[[f["name"] for f in factors]].itertuples(index=False, name=None))
    assert found == list(product(*levels))
    assert table["case_id"].is_unique
