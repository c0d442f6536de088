"""Flags of the specimens collected by standard and kind."""

import pandas as pd
import pytest
from hypothesis import given
from hypothesis import strategies as st

from nptcs.config.materials.reduction import ReductionSettings
from nptcs.reduce.groups.flag_groups import NUMBER, flag_kind, group_flags, with_ranges
from nptcs.tables.io import check
from nptcs.tables.laboratory.flags import FlagsTable


def properties(*rows):
    columns = ["specimen", "test", "property", "flags"]
    return pd.DataFrame(rows, columns=columns)


EARLY = "failure after {} min, ASTM D3039 requires 1 to 10 min"


def test_flags_that_differ_in_numbers_are_one_with_the_range():
    table = group_flags(
        properties(
            ("T90-1", "tension", "modulus", EARLY.format(0.95)),
            ("T90-1", "tension", "strength", EARLY.format(0.95)),
            (
                "T90-2",
                "tension",
                "modulus",
                EARLY.format(0.98) + "; width measured at 1 of 3 stations",
            ),
            ("C0-1", "compression", "poisson_ratio", "not assessed: no transverse strain"),
            ("C0-2", "compression", "modulus", ""),
        ),
        ReductionSettings(),
    )
    check(table, FlagsTable, "flags")
    assert list(table["kind"]) == ["deviation", "deviation", "not assessed"]
    first = table.iloc[0]
    assert first["flag"] == EARLY.format("0.95 to 0.98")
    assert (first["specimens"], first["names"]) == (2, "T90-1, T90-2")
    assert first["properties"] == "modulus, strength"
    assert list(table["standard"]) == ["ASTM D3039", "ASTM D3039", "ASTM D6641"]


def test_the_standard_is_the_one_in_force():
    settings = ReductionSettings(tension_standard="iso_527_4")
    table = group_flags(properties(("T0-1", "tension", "modulus", "crosshead strain: x")), settings)
    assert table[["standard", "kind"]].to_numpy().tolist() == [["ISO 527-4", "deviation"]]


def test_specimens_without_flags_give_no_rows():
    table = group_flags(properties(("T0-1", "tension", "modulus", "")), ReductionSettings())
    assert check(table, FlagsTable, "flags").empty


@pytest.mark.parametrize(
    ("flag", "kind"),
    [
        ("crosshead strain: it includes the compliance of machine and grips", "deviation"),
        ("source of the strain not stated", "deviation"),
        ("thickness measured at 2 of 3 stations", "deviation"),
        ("width not given, area: stated in the sheet", "deviation"),
        ("width 26 mm, ASTM D3039 recommends 14 to 16 mm", "deviation"),
        ("not assessed: no transverse strain", "not assessed"),
        ("strain at the largest force extended", "remark"),
    ],
)
def test_kinds(flag, kind):
    assert flag_kind(flag, "ASTM D3039") == kind


def test_names_with_digits_are_not_numbers():
    one, other = "mean of the runs T0-1, T0-2", "mean of the runs T0-1, T0-3"
    assert NUMBER.sub("#", one) == one
    assert NUMBER.sub("#", other) != NUMBER.sub("#", one)


@given(st.lists(st.floats(-1e6, 1e6, allow_nan=False), min_size=1, max_size=6))
def test_the_range_contains_every_value(values):
    flags = [f"failure after {value:.4g} min, requires 1 to 10" for value in values]
    ends = [float(text) for text in NUMBER.findall(with_ranges(flags))][:-2]
    shown = [float(f"{value:.4g}") for value in values]
    assert (ends[0], ends[-1]) == (min(shown), max(shown))
