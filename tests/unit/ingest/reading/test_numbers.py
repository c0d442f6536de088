"""Decimal marks, thousands, delimiters: right, or refused with the choices."""

from __future__ import annotations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from nptcs.errors import InputError
from nptcs.ingest.reading.profiles import FormatProfile
from nptcs.ingest.reading.text.dialect import Dialect, find_dialect

PLAIN = FormatProfile(name="plain", title="any")
HEAD = "time (s){0}force (N){0}strain (%)"


def table(cells, delimiter=";"):
    lines = [HEAD.format(delimiter), *(delimiter.join(row) for row in cells)]
    return "\n".join(lines)


def find(cells, delimiter=";", profile=PLAIN):
    return find_dialect(table(cells, delimiter).split("\n"), profile, "test.csv")


@pytest.mark.parametrize(
    ("cell", "decimal", "thousands"),
    [
        ("0,5", ",", ""),
        ("12,34", ",", ""),
        ("1.234,5", ",", "."),
        ("0.5", ".", ""),
        ("1234.567", ".", ""),
        ("1,234.5", ".", ","),
        ("1,234,567", ".", ","),
        ("-1.5e-03", ".", ""),
        ("-1,5E-03", ",", ""),
    ],
)
def test_a_number_that_can_be_read_one_way_decides(cell, decimal, thousands):
    dialect = find([["1", "2", "3"], ["4", "5", "6"], ["7", cell, "9"], ["2", "3", "4"]])
    assert (dialect.decimal, dialect.thousands) == (decimal, thousands)


@pytest.mark.parametrize("cell", ["1,234", "1.234", "12,345", "-999.999"])
def test_a_number_that_can_be_read_two_ways_is_refused_with_line_and_choices(cell):
    with pytest.raises(InputError, match="can be read in 2 ways") as caught:
        find([["1", "2", "3"], ["4", "5", "6"], ["7", cell, "9"]])
    assert caught.value.line == 4
    assert "decimal mark ','" in str(caught.value)
    assert "decimal mark '.'" in str(caught.value)


def test_a_declared_decimal_mark_settles_it():
    declared = PLAIN.model_copy(update={"decimal": ","})
    assert find([["1", "1,234", "3"]] * 4, profile=declared) == Dialect(";", ",")


def test_one_telling_number_anywhere_in_a_long_file_settles_it():
    cells = [["1", "1,234", "3"]] * 500 + [["1", "0,25", "3"]] + [["1", "1,234", "3"]] * 2000
    assert find(cells).decimal == ","


def test_quoted_thousands(read):
    lines = ['"Time (s)","Force (N)","Strain (%)"']
    lines += [f'"{n}.0","242,37{n}.29658","0.{n}1"' for n in range(6)]
    table = read("\n".join(lines))
    assert table.values["force"] == pytest.approx([242370.29658 + n for n in range(6)])


@pytest.mark.parametrize("delimiter", [",", ";", "\t", "|", "   "])
def test_delimiters(read, delimiter):
    cells = [[f"{n}.5", f"{10 * n}.25", f"0.{n}1"] for n in range(6)]
    names = ["time_s", "force_N", "strain_%"]
    values = read("\n".join(delimiter.join(row) for row in [names, *cells])).values
    assert values["force"] == pytest.approx([10 * n + 0.25 for n in range(6)])


def test_decimal_comma_in_comma_separated_quotes(read):
    lines = ['"time (s)","force (N)","strain (%)"']
    lines += [f'"0,{n}","{n},25","0,0{n}"' for n in range(6)]
    assert read("\n".join(lines)).values["force"] == pytest.approx([n + 0.25 for n in range(6)])


@settings(max_examples=60)
@given(
    numbers=st.lists(
        st.tuples(*[st.floats(-1e6, 1e6, allow_nan=False).map(lambda x: round(x, 5))] * 3),
        min_size=5,
        max_size=20,
    ),
    delimiter=st.sampled_from([";", "\t", "|"]),
    decimal=st.sampled_from([".", ","]),
)
def test_any_table_is_read_correctly_or_refused(numbers, delimiter, decimal):
    cells = [[repr(number).replace(".", decimal) for number in row] for row in numbers]
    try:
        dialect = find(cells, delimiter)
    except InputError:
        return
    back = [
        [float(cell.replace(dialect.thousands, "").replace(dialect.decimal, ".")) for cell in row]
        if dialect.thousands
        else [float(cell.replace(dialect.decimal, ".")) for cell in row]
        for row in cells
    ]
    assert back == [list(row) for row in numbers]
    assert dialect.delimiter == delimiter


@pytest.mark.parametrize(
    "cell", ["1_000", "0x1A", "1.2.3", "1e", "--5", "1,5,2", "１２", "+-3", "1d5", "true"]
)
def test_a_cell_that_is_not_a_number_is_named(read, cell):
    lines = ["time_s;force_N;strain_%", *(f"0.{n};{n}.5;0.0{n}" for n in range(1, 8))]
    lines[4] = f"0.4;{cell};0.04"
    with pytest.raises(InputError) as caught:
        read("\n".join(lines))
    assert caught.value.line == 5
    assert caught.value.column == "force"
    assert caught.value.value == cell


@pytest.mark.parametrize("cell", ["1e400", "-1e999"])
def test_a_number_that_is_too_large_is_named(read, cell):
    lines = ["time_s;force_N;strain_%", *(f"0.{n};{n}.5;0.0{n}" for n in range(1, 8))]
    lines[4] = f"0.4;{cell};0.04"
    with pytest.raises(InputError, match="too large") as caught:
        read("\n".join(lines))
    assert caught.value.line == 5


@pytest.mark.parametrize("grouped", ["61 000.1", "61,000.1"])
def test_a_number_that_is_too_large_is_named_next_to_grouped_digits(read, grouped):
    lines = ["time_s;force_N;strain_%", *(f"0.{n};{n}.5;0.0{n}" for n in range(1, 8))]
    lines[3] = f"0.3;{grouped};0.03"
    assert 61000.1 in read("\n".join(lines)).values["force"]
    lines[4] = "0.4;1e400;0.04"
    with pytest.raises(InputError, match="too large") as caught:
        read("\n".join(lines))
    assert caught.value.line == 5


@pytest.mark.parametrize("word", ["", "nan", "NaN", "-", "---", "n/a", "#N/A", "1.#QNAN"])
def test_missing_values(read, word):
    lines = ["time_s;force_N;strain_%", *(f"0.{n};{n}.5;0.0{n}" for n in range(1, 8))]
    lines[4] = f"0.4;4.5;{word}"
    strain = read("\n".join(lines)).values["strain"]
    assert [index for index, value in enumerate(strain) if value != value] == [3]


def test_a_thousands_mark_that_nothing_proves_is_not_accepted(read):
    """A comma mistyped as a point must not multiply by a thousand."""
    lines = ["time_s;force_N;strain_%", *(f"0,{n};{n},234;0,0{n}" for n in range(1, 8))]
    lines[4] = "0,4;4.234;0,04"
    with pytest.raises(InputError, match="not a number") as caught:
        read("\n".join(lines))
    assert (caught.value.line, caught.value.value) == (5, "4.234")
