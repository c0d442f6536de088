"""Cases solved as a table have the numbers of single cases; each fault is a row."""

from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import pandas as frames

from nptcs.campaign.batch import solve_batch
from nptcs.campaign.bulk import in_bulk, known_in_bulk, solve_bulk
from nptcs.campaign.bulk_file import read_bulk, write_bulk
from nptcs.campaign.cases import cases_table, read_cases, read_tyres
from nptcs.campaign.record import RecordStore, write_records
from nptcs.config.solvers.tyre import TyreGeometry
from nptcs.config.studies.responses import TyreResponseSettings
from nptcs.config.studies.study import Study
from nptcs.design import build_design
from nptcs.errors import InputError
from nptcs.responses.strength import PlyStrengths
from nptcs.responses.table import tyre_responses
from nptcs.solvers.registry import MODULES, load_solver
from nptcs.solvers.tables import CURVE
from nptcs.tables.io import check
from nptcs.tables.tyres.cases import Cases

FAULTY = {"module": str(Path(__file__).with_name("faulty_table_solver.py"))}
PUBLISHED = Path(__file__).parents[3] / "raw_data/published"


def study_of(factors, solver):
    listed = [
        {"name": name, "label": name, "unit": "", "levels": levels}
        for name, levels in factors.items()
    ]
    return Study(name="s", title="", factors=listed, solvers=[solver])


def edit_number(path, name):
    with np.load(path) as stored:
        arrays = dict(stored)
    arrays[name] = arrays[name] + 1.0
    np.savez_compressed(path, **arrays)


def solve(study, solver, options, store, batch=1, batches=1):
    design = build_design(study, {}, TyreGeometry())
    job = {
        "study": study.case_definition(),
        "solver": solver,
        "options": options,
        "tyre": TyreGeometry().model_dump(),
        "batch": batch,
        "batches": batches,
    }
    return job, design, solve_bulk(job, design, None, store, 2, 0, store / "log")


@pytest.mark.parametrize(
    ("solver", "options", "factors"),
    [
        (
            "lca",
            {"spoke_stiffness_table": str(PUBLISHED / "table10_spoke_stiffness.csv")},
            # a spoke beyond table 10, and a band that the load presses onto the rim
            {"shear_band_c10_mpa": [0.001, 1.0, 5.0], "spoke_c10_mpa": [1.0, 2.5, 5.0, 5.5]},
        ),
        (
            "lca",
            {
                "spoke_stiffness_table": str(PUBLISHED / "table10_spoke_stiffness.csv"),
                "contact_spokes": "local",
            },
            {"shear_band_c10_mpa": [4.0, 5.0], "spoke_c10_mpa": [1.0, 5.5]},
        ),
        (
            "published",
            {"archive": str(PUBLISHED / "table7_rubber_doe.csv")},
            {"shear_band_c10_mpa": [3.0, 4.0, 6.0], "spoke_c10_mpa": [1.0, 2.0, 2.5]},
        ),
    ],
)
def test_a_table_has_the_numbers_of_single_cases(tmp_path, solver, options, factors):
    study = study_of(factors, solver)
    job, design, (table, again) = solve(study, solver, options, tmp_path / "store")
    records = solve_batch(
        job, design, None, RecordStore(tmp_path / "records"), 2, 0, tmp_path / "l"
    )
    single = cases_table(records)

    assert not again
    assert "ok" in set(single["status"])
    assert "error" in set(single["status"])
    checked = check(table, Cases, "cases")
    assert list(checked["status"]) == list(single["status"])
    assert list(checked["message"]) == list(single["message"])
    # a table also keeps the points of a curve
    assert set(single) == {name for name in table if not name.startswith(CURVE)}
    numbers = [name for name in single.select_dtypes("number") if name != "wall_time_s"]
    np.testing.assert_allclose(table[numbers], single[numbers], rtol=1e-9, atol=1e-12)


def test_each_fault_is_a_row_and_the_other_cases_are_solved(tmp_path):
    kinds = [10.0, 1.0, 2.0, 3.0, 4.0, 5.0, 7.0, 11.0, 12.0]
    study = study_of({"kind": sorted(kinds)}, "faulty")
    _, _, (table, again) = solve(study, "faulty", FAULTY, tmp_path)
    ended = {row.kind: (row.status, row.message) for row in table.itertuples()}

    assert ended[1] == (
        "error",
        "RuntimeError: the mesh has folded (faulty_table_solver.py, line 25)",
    )
    assert ended[2][0] == "timeout"
    assert ended[3] == ("error", "the solver's process was killed by signal SIGKILL")
    assert ended[4] == ("error", "the solver's process was killed by signal SIGSEGV")
    assert ended[5] == ("error", "solver 'faulty' says ok but gives no result")
    assert ended[7] == ("error", "out of memory: no room for 8 GB")
    for kind in (10, 11, 12):
        assert ended[kind] == ("ok", "")
    assert again  # killed, out of time, out of memory
    assert table.loc[table["status"] != "ok", "vertical_stiffness_n_per_mm"].isna().all()


def test_levels_that_are_added_solve_the_new_cases_only(tmp_path):
    few = study_of({"kind": [10.0, 11.0]}, "faulty")
    more = study_of({"kind": [10.0, 10.5, 11.0, 12.0]}, "faulty")
    _, _, (first, _) = solve(few, "faulty", FAULTY, tmp_path)
    design = build_design(more, {}, TyreGeometry())
    given = (more, "faulty", FAULTY, TyreGeometry(), design, None, tmp_path)
    assert known_in_bulk(*given) == 2
    _, _, (second, _) = solve(more, "faulty", FAULTY, tmp_path)

    process = second.set_index("kind")["process"]
    assert list(process[[10.0, 11.0]]) == list(first["process"])
    assert not set(process[[10.5, 12.0]]) & set(first["process"])
    assert list(second["case_id"]) == ["s_001", "s_002", "s_003", "s_004"]
    assert known_in_bulk(*given) == 4


def test_a_store_that_was_edited_is_solved_again(tmp_path):
    study = study_of({"kind": [10.0, 11.0]}, "faulty")
    _, _, (first, _) = solve(study, "faulty", FAULTY, tmp_path)
    for file in tmp_path.glob("bulk/*/*.npz"):
        edit_number(file, "displacement_mm")
    _, _, (second, _) = solve(study, "faulty", FAULTY, tmp_path)

    assert not set(first["process"]) & set(second["process"])
    assert list(first["key"]) == list(second["key"])


def test_batches_divide_the_cases(tmp_path):
    study = study_of({"kind": [10.0, 11.0, 12.0]}, "faulty")
    parts = [solve(study, "faulty", FAULTY, tmp_path, batch, 2)[2][0] for batch in (1, 2)]
    assert [list(part["kind"]) for part in parts] == [[10.0, 12.0], [11.0]]


def test_which_solvers_solve_tables():
    able = {name for name in MODULES if in_bulk(load_solver(MODULES[name]), 1000, 1000)}
    assert able == {"lca", "published", "ring"}
    assert not in_bulk(load_solver(MODULES["lca"]), 999, 1000)


TABLES = frames.data_frames(
    [
        frames.column("case_id", elements=st.text(max_size=5), dtype=object),
        frames.column("value_mm", elements=st.floats(), dtype=float),
    ]
)


@given(TABLES)
def test_a_file_contains_what_was_written(tmp_path_factory, table):
    path = tmp_path_factory.mktemp("bulk") / "b.npz"
    write_bulk(path, table)
    once = path.read_bytes()
    read = read_bulk(path)
    assert list(read["case_id"]) == list(table["case_id"])
    np.testing.assert_array_equal(read["value_mm"].to_numpy(float), table["value_mm"].to_numpy())
    write_bulk(path, read.astype({"value_mm": float}))
    assert path.read_bytes() == once


@pytest.mark.parametrize("share", [0.0, 0.3, 0.6, 0.9])
def test_a_file_that_is_cut_off_is_an_error(tmp_path, share):
    path = tmp_path / "b.npz"
    write_bulk(path, pd.DataFrame({"case_id": ["a"], "value_mm": [1.0]}))
    content = path.read_bytes()
    path.write_bytes(content[: int(share * len(content))])
    with pytest.raises(InputError, match="cannot be used"):
        read_bulk(path)


def test_an_edited_number_is_an_error(tmp_path):
    path = tmp_path / "b.npz"
    write_bulk(path, pd.DataFrame({"case_id": ["a"], "value_mm": [1.0]}))
    edit_number(path, "value_mm")
    with pytest.raises(InputError, match="does not match its checksum"):
        read_bulk(path)


def test_records_and_tables_are_joined(tmp_path):
    study = study_of({"kind": [10.0, 11.0]}, "faulty")
    job, design, (table, _) = solve(study, "faulty", FAULTY, tmp_path)
    write_bulk(tmp_path / "bulk_1.npz", table)
    other = study_of({"kind": [12.0, 13.0]}, "faulty").model_copy(update={"name": "t"})
    job = {**job, "study": other.case_definition()}
    records = solve_batch(
        job,
        build_design(other, {}, TyreGeometry()),
        None,
        RecordStore(tmp_path / "r"),
        1,
        0,
        tmp_path / "l",
    )
    write_records(tmp_path / "batch_1.jsonl", records)
    joined = read_cases([str(tmp_path / "bulk_1.npz"), str(tmp_path / "batch_1.jsonl")])

    assert list(check(joined, Cases, "cases")["kind"]) == [12.0, 13.0, 10.0, 11.0]
    assert list(joined)[:5] == ["study", "case_id", "solver", "status", "message"]
    assert list(joined)[-3:] == ["wall_time_s", "solver_version", "key"]


@pytest.mark.parametrize("in_bulk", [False, True], ids=["records", "tables"])
@pytest.mark.parametrize("batches", [1, 2, 3, 7])
def test_cases_are_in_the_order_of_the_design_whatever_the_batches(tmp_path, batches, in_bulk):
    study = study_of({"kind": [10.0, 11.0, 12.0, 13.0, 14.0, 15.0]}, "faulty")
    job, design, (table, _) = solve(study, "faulty", FAULTY, tmp_path)
    records = solve_batch(job, design, None, RecordStore(tmp_path / "r"), 1, 0, tmp_path / "l")
    files = []
    for batch in range(batches):  # as `solve_batch` and `solve_in_bulk` divide a design
        files.append(str(tmp_path / f"batch_{batch + 1}.{'npz' if in_bulk else 'jsonl'}"))
        if in_bulk:
            write_bulk(files[-1], table.iloc[batch::batches].reset_index(drop=True))
        else:
            write_records(files[-1], records[batch::batches])
    assert tuple(read_cases(files)["kind"]) == study.factors[0].levels


def test_tyres_of_a_table_have_the_curves_of_single_cases(tmp_path):
    options = {
        "spoke_stiffness_table": str(PUBLISHED / "table10_spoke_stiffness.csv"),
        "contact_spokes": "local",
    }
    # the spoke of 5.5 MPa is beyond table 10: a failed case, with no curve
    study = study_of({"shear_band_c10_mpa": [4.0, 5.0], "spoke_c10_mpa": [1.0, 5.5]}, "lca")
    job, design, (table, _) = solve(study, "lca", options, tmp_path)
    write_bulk(tmp_path / "bulk_1.npz", table)
    records = solve_batch(job, design, None, RecordStore(tmp_path / "one"), 1, 0, tmp_path / "log")
    write_records(tmp_path / "batch_1.jsonl", records)

    of_table = read_tyres([str(tmp_path / "bulk_1.npz")])
    of_records = [
        record for record in read_tyres([str(tmp_path / "batch_1.jsonl")]) if record.result.curve
    ]

    assert [tyre.case_id for tyre in of_table] == ["s_001", "s_003"]
    for one, other in zip(of_table, of_records, strict=True):
        assert one.values == other.values
        for name, points in other.result.curve.items():
            assert one.result.curve[name] == pytest.approx(points, rel=1e-9)
    settings, strengths = TyreResponseSettings(loads_n=(3000.0,)), PlyStrengths()
    ours, theirs = (tyre_responses(r, settings, strengths) for r in (of_table, of_records))
    assert ours["status"].tolist() == theirs["status"].tolist()
    assert ours["value"].to_numpy() == pytest.approx(theirs["value"], rel=1e-9, nan_ok=True)
    secant = ours[(ours["response"] == "secant_stiffness") & (ours["at"] == "3000 N")]
    assert len(secant) == 2
    assert secant["value"].notna().all()
    assert not [name for name in read_cases([str(tmp_path / "bulk_1.npz")]) if "curve" in name]
