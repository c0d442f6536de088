"""The catalogue of result tables is unambiguous."""

import pytest

from nptcs.tables.analysis.impact import Impact
from nptcs.tables.analysis.surface import SurfaceTable
from nptcs.tables.catalogue import TABLES, file_of, result_files
from nptcs.tables.published.inputs import PublishedImpact


def test_a_contract_belongs_to_one_table():
    contracts = [table.contract for table in TABLES.values()]
    assert len(set(contracts)) == len(contracts)


def test_headings_are_of_columns_that_exist():
    for name, table in TABLES.items():
        assert set(table.headings) <= set(table.contract.to_schema().columns), name


def test_a_table_is_found_by_its_contract():
    assert file_of(Impact) == "impact.csv"
    assert file_of(SurfaceTable, "plate") == "plate_surface.csv"
    with pytest.raises(KeyError, match="PublishedImpact"):
        file_of(PublishedImpact)


def test_a_table_per_study_is_a_file_per_study():
    files = {file: study for file, _, study in result_files(["a", "b"])}
    assert {file: study for file, study in files.items() if study} == {
        "a_surface.csv": "a",
        "b_surface.csv": "b",
    }
    assert len(files) == len(TABLES) + 1
