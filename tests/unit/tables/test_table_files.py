"""Tables survive a round trip through a file, and a broken one is named with line and column."""

import numpy as np
import pandas as pd
import pytest

from nptcs.errors import InputError
from nptcs.files import atomic_path
from nptcs.tables.analysis.impact import Impact
from nptcs.tables.io import empty_table, read_alike, read_table, write_table
from nptcs.tables.laboratory.curves import CURVE_COLUMNS, Curve
from nptcs.tables.problems import Problems, problems_table


@pytest.fixture
def impact():
    return pd.DataFrame(
        {
            "solver": "lca",
            "study": ["001", "NA"],
            "factor": "spoke_c10_mpa",
            "rule": "domain_mean_signed",
            "gradient": [1 / 3, -2.0],
            "range": [4.0, 1.0],
            "impact": [4 / 3, -2.0],
            "nominal_range": [4.0, 1.0],
            "values_used": "levels",
            "cases": 15,
            "failed_cases": 0,
            "near_tie_with": "",
            "published_gradient": [np.nan, 1.0],
            "published_impact": [np.nan, 2.0],
            "difference_percent": [np.nan, 0.0],
            "rank": pd.array([None, 1], dtype="Int64"),
            "published_rank": pd.array([None, 1], dtype="Int64"),
        }
    )


def test_numbers_and_text_are_read_back_exactly(tmp_path, impact):
    write_table(tmp_path / "impact.csv", impact, Impact)
    again = read_table(tmp_path / "impact.csv", Impact)
    assert again["gradient"].tolist() == [1 / 3, -2.0]
    assert again["study"].tolist() == ["001", "NA"]
    assert again["published_impact"].isna().tolist() == [True, False]
    assert again["rank"].tolist() == [pd.NA, 1]


def test_empty_text_stays_text(tmp_path):
    table = problems_table([("solve", "c", "", "error", 'it, "fell"\nover')])
    write_table(tmp_path / "problems.csv", table, Problems)
    pd.testing.assert_frame_equal(read_table(tmp_path / "problems.csv", Problems), table)


def test_a_table_without_rows_is_read_back(tmp_path):
    write_table(tmp_path / "empty.csv", empty_table(Impact), Impact)
    assert list(read_table(tmp_path / "empty.csv", Impact)) == list(Impact.to_schema().columns)


def test_a_broken_value_is_named_with_file_line_and_column(tmp_path, impact):
    impact.to_csv(tmp_path / "impact.csv", index=False)
    text = (tmp_path / "impact.csv").read_text().replace("-2.0,1.0,", "-2.0,-1.0,")
    (tmp_path / "impact.csv").write_text(text)
    with pytest.raises(InputError) as refusal:
        read_table(tmp_path / "impact.csv", Impact)
    assert "impact.csv:3, column 'range'" in str(refusal.value)
    assert "-1.0" in str(refusal.value)


def test_a_missing_column_and_a_missing_file_are_named(tmp_path, impact):
    impact.drop(columns="rule").to_csv(tmp_path / "impact.csv", index=False)
    with pytest.raises(InputError, match="rule"):
        read_table(tmp_path / "impact.csv", Impact)
    with pytest.raises(InputError, match="does not exist"):
        read_table(tmp_path / "none.csv", Impact)


def test_a_table_that_breaks_its_contract_is_not_written(tmp_path, impact):
    with pytest.raises(InputError):
        write_table(tmp_path / "impact.csv", impact.assign(range=-1.0), Impact)
    assert list(tmp_path.iterdir()) == []


def test_an_interrupted_write_leaves_the_old_file_alone(tmp_path):
    target = tmp_path / "file.txt"
    target.write_text("old")

    def write_half():
        with atomic_path(target) as temporary:
            temporary.write_text("half of the ne")
            raise RuntimeError("out of power")

    with pytest.raises(RuntimeError):
        write_half()
    assert target.read_text() == "old"
    assert list(tmp_path.iterdir()) == [target]


@pytest.fixture
def curve_files(tmp_path):
    """Two curves: whole numbers and no second strain in the one, fractions in the other."""
    whole = pd.DataFrame({name: [0.0, 1.0] for name in CURVE_COLUMNS})
    whole["strain_axial_back"] = np.nan
    write_table(tmp_path / "T0-1.csv", whole, Curve)
    write_table(tmp_path / "T0-2.csv", whole + 1 / 3, Curve)
    write_table(tmp_path / "T0-3.csv", empty_table(Curve), Curve)
    return [tmp_path / f"T0-{number}.csv" for number in (1, 2, 3)]


def test_tables_that_are_checked_at_once_are_those_that_are_checked_one_by_one(curve_files):
    at_once = read_alike(curve_files, Curve)
    for table, file in zip(at_once, curve_files, strict=True):
        pd.testing.assert_frame_equal(table, read_table(file, Curve), check_exact=True)


@pytest.mark.parametrize(("column", "line"), [("force_n", 3), ("strain_axial", None)])
def test_the_broken_one_of_several_tables_is_named(curve_files, column, line):
    table = read_table(curve_files[1], Curve)
    broken = table.drop(columns=column) if line is None else table.assign(**{column: [1.0, np.nan]})
    broken.to_csv(curve_files[1], index=False)
    with pytest.raises(InputError) as raised:
        read_alike(curve_files, Curve)
    assert (raised.value.file, raised.value.line) == (str(curve_files[1]), line)
