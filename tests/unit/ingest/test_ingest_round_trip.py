"""Numbers written in any format are read back; mutated files are read correctly or refused."""

from __future__ import annotations

import csv
import importlib.util
import io
import sys
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from nptcs.errors import InputError
from nptcs.example import exports
from nptcs.example.tests import Draw
from nptcs.ingest.reading.columns.labels import read_labels
from nptcs.ingest.reading.text.dialect import Dialect

ROOT = Path(__file__).resolve().parents[3]
SPECIMEN = Draw("A-1", (10.01, 10.03), (1.0, 1.02), 1.0, 0.3, 1.0)
TIME = np.arange(40) * 0.25
FORCE = np.linspace(-3.1, 2750.7, 40)
STRAIN = np.linspace(-2e-5, 0.0123, 40)


def test_bluehill(read):
    columns = {("Time", "s"): TIME, ("Load", "kN"): FORCE / 1000, ("Strain 1", "%"): 100 * STRAIN}
    table = read(exports.bluehill_csv(SPECIMEN, columns, "note"))
    assert table.profile.name == "bluehill-en"
    assert table.values["time"] == pytest.approx(TIME, abs=5e-7)
    assert table.values["force"] == pytest.approx(FORCE, abs=5e-4)
    assert table.values["strain"] == pytest.approx(STRAIN, abs=5e-9)
    assert table.labels["width"].value == pytest.approx(10.02)


def test_testxpert_german(read):
    columns = {
        ("Prüfzeit", "s"): TIME,
        ("Standardkraft", "N"): FORCE,
        ("Dehnung", "%"): 100 * STRAIN,
    }
    table = read(exports.testxpert_german(SPECIMEN, columns, 6.0))
    assert table.profile.name == "testxpert-de"
    assert table.values["force"] == pytest.approx(FORCE, rel=5e-6)
    assert table.values["strain"] == pytest.approx(STRAIN, rel=5e-6)
    assert table.labels["gauge_length"].value == 6.0


def test_wdw(read):
    table = read(exports.wdw_gbk(TIME, 10 * STRAIN, FORCE))
    assert (table.profile.name, table.encoding) == ("wdw-gbk", "gb18030")
    assert table.values["force"] == pytest.approx(FORCE, abs=5.1e-3)


def test_vic_3d(read):
    strain = STRAIN.copy()
    strain[5:8] = np.nan
    table = read(exports.vic_3d(TIME, strain, -0.3 * STRAIN, 0 * STRAIN), role="strain")
    assert table.profile.name == "vic-3d"
    assert table.values["strain_xx"] == pytest.approx(strain, abs=5.1e-8, nan_ok=True)


NUMBERS = st.floats(-1e5, 1e5, allow_nan=False).map(lambda number: round(number, 4))
TABLES = st.lists(st.tuples(NUMBERS, NUMBERS, NUMBERS), min_size=6, max_size=30)


@settings(
    suppress_health_check=[HealthCheck.function_scoped_fixture], deadline=None, max_examples=50
)
@given(
    rows=TABLES,
    delimiter=st.sampled_from([",", ";", "\t"]),
    decimal=st.sampled_from([".", ","]),
    end=st.sampled_from(["\n", "\r\n", "\r"]),
    encoding=st.sampled_from(["utf-8", "utf-8-sig", "utf-16", "cp1252"]),
    quoting=st.sampled_from([csv.QUOTE_MINIMAL, csv.QUOTE_ALL]),
    head=st.lists(st.text("abc äöü:", max_size=20), max_size=5),
)
def test_any_plain_table_is_read_correctly_or_refused(
    read, rows, delimiter, decimal, end, encoding, quoting, head
):
    out = io.StringIO(newline="")
    writer = csv.writer(out, delimiter=delimiter, quoting=quoting, lineterminator=end)
    writer.writerow(["Zeit (s)", "Kraft (N)", "Dehnung (%)"])
    writer.writerows([[repr(number).replace(".", decimal) for number in row] for row in rows])
    text = "".join(f"{line}{end}" for line in head) + out.getvalue()
    try:
        table = read(text.encode(encoding))
    except InputError:
        return  # the refusals have their own tests
    assert table.values["force"].tolist() == [row[1] for row in rows]
    assert table.values["time"].tolist() == [row[0] for row in rows]


def test_mutated_files_are_read_correctly_or_refused():
    spec = importlib.util.spec_from_file_location(
        "ingest_fuzz", ROOT / "benchmarks" / "ingest_fuzz.py"
    )
    module = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = module
    spec.loader.exec_module(module)
    outcome, failures = module.fuzz(80, 5, None)
    assert failures == []
    assert outcome["refused"] > 10
    assert outcome["read and ingested"] > 10


def test_labels_in_rows_in_columns_and_behind_a_group(profiles):
    rows = [
        ["General : Width", "12.5", "mm"],
        ["", "Thickness (mm)", "Specimen label"],
        ["1", "2.1", "A-1"],
        [""],
        ["Specimen Cross-section (cm^2)", "0.18"],
    ]
    labels = read_labels(rows, profiles["plain"], Dialect(",", "."))
    assert labels["width"].value == 12.5
    assert labels["thickness"].value == 2.1
    assert labels["area"].value == pytest.approx(18)


def test_results_of_several_specimens_belong_to_none(profiles):
    rows = [["", "Width (mm)"], ["1", "12.5"], ["2", "12.6"]]
    assert read_labels(rows, profiles["plain"], Dialect(",", ".")) == {}
