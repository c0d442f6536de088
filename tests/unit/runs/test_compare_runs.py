"""Two runs compared: what differs is named, what cannot be compared is reported."""

import json
import shutil
import zipfile

import numpy as np
import pandas as pd
import pytest

from nptcs.cli import main
from nptcs.errors import InputError
from nptcs.runs.all_tables import described
from nptcs.runs.compare import compare_runs
from nptcs.runs.constants import beyond
from nptcs.runs.finished import read_run
from nptcs.runs.part import RESULT, Found
from nptcs.runs.settings import flattened

from .conftest import (
    C10,
    ERROR,
    MARKS,
    OTHER_MARKS,
    OTHER_RUBBER,
    configuration,
    identify_run,
    write_run,
)


def both(a, b, **options):
    return compare_runs(read_run(a, "A"), read_run(b, "B"), **options)


def rewritten(**columns):
    """Return what changes columns of a table on disk."""

    def change(path):
        pd.read_csv(path).assign(**columns).to_csv(path, index=False)

    return change


@pytest.fixture(scope="module")
def rubber(march, april):
    return both(march, april)


def test_a_run_and_itself_have_no_difference(march, capsys):
    assert main(["compare", str(march), str(march)]) == 0
    said = capsys.readouterr().out
    assert "No difference between the two runs." in said
    assert "Both runs have the same identity." in said


def test_times_are_not_a_difference(march, tmp_path):
    slow = write_run(tmp_path, C10, MARKS, wall_time=99.0, day=9)
    done = both(march, slow)
    assert done.same
    assert done.same_identity


def test_another_rubber_is_found_in_every_part_that_it_reaches(rubber):
    assert rubber.part("inputs").differences["file"].tolist() == [
        f"raw_data/example/rubber_88A-{number}.csv" for number in (1, 2, 3)
    ]
    constants = rubber.part("constants").differences
    assert constants["material"].tolist() == ["rubber_88A"]
    cases = rubber.part("stiffness").differences
    assert cases["case_a"].tolist() == ["tested_002", "tested_004", "tested_006"]
    assert cases["difference_n_per_mm"].to_numpy() == pytest.approx(60.0 * (3.10 - 2.93))
    assert rubber.part("ranking").differences["factor"].tolist() == ["spoke_c10_mpa"]
    assert rubber.part("configuration").same
    assert rubber.part("software").same
    changed = described(rubber.part("all_tables"))
    assert set(changed) == {"cases.csv", "files.csv", "response_impact.csv"}


def test_a_constant_is_beyond_its_uncertainty_by_both_standard_errors(rubber, march, april):
    (row,) = beyond(rubber.part("constants")).to_dict("records")
    assert row["combined_standard_error"] == pytest.approx(np.sqrt(2 * ERROR**2))
    ratio = (3.10 - 2.93) / np.sqrt(2 * ERROR**2)
    assert row["difference_over_error"] == pytest.approx(ratio)  # 6.01
    assert row["data"] == "other files"
    assert len(beyond(both(march, april, k=6.0).part("constants"))) == 1
    assert beyond(both(march, april, k=6.1).part("constants")).empty


def test_constants_of_the_same_files_are_not_judged_by_scatter(march, tmp_path):
    again = write_run(tmp_path, OTHER_RUBBER, MARKS)  # another rule, the same files
    row = both(march, again).part("constants").differences.iloc[0]
    assert row["data"] == "same files"
    assert row["beyond_uncertainty"] == "not assessed"


def test_an_assumption_has_no_uncertainty_to_be_beyond(rubber):
    table = rubber.part("constants").table
    ply = table[table["constant"] == "g23_mpa"].iloc[0]
    assert ply[RESULT] == Found.SAME
    assert ply["beyond_uncertainty"] == "not assessed"


def test_other_units_are_not_compared(march, tmp_path):
    kpa = write_run(tmp_path, C10, MARKS, unit="kPa")
    row = both(march, kpa).part("constants").differences.iloc[0]
    assert row[RESULT] == Found.NOT_COMPARED
    assert row["note"] == "the unit is MPa in A and kPa in B"


def test_other_loads_are_not_compared(march, tmp_path):
    lighter = write_run(tmp_path, C10, MARKS, load=4000.0, config=configuration(load_n=4000.0))
    done = both(march, lighter)
    part = done.part("stiffness")
    assert set(part.table[RESULT]) == {Found.NOT_COMPARED}
    assert part.table["note"].unique().tolist() == ["solved at 5000 N in A and 4000 N in B"]
    assert part.table["difference_n_per_mm"].isna().all()
    key = done.part("configuration").differences
    assert key["key"].tolist() == ["studies[tested].load_n"]


def test_a_lost_result_is_a_difference(march, tmp_path):
    lost = write_run(
        tmp_path,
        C10,
        MARKS,
        changes={
            "cases.csv": rewritten(
                status=["diverged", *["ok"] * 5],
                vertical_stiffness_n_per_mm=lambda table: table[
                    "vertical_stiffness_n_per_mm"
                ].where(table.index > 0),
            )
        },
    )
    done = both(march, lost)
    (row,) = done.part("stiffness").differences.to_dict("records")
    assert (row["case_a"], row["status_b"], row[RESULT]) == ("tested_001", "diverged", "different")
    assert done.part("stiffness_summary").table["without_result_b"].tolist() == [1]
    words = described(done.part("all_tables"))["cases.csv"]
    assert "numbers missing in one run: vertical_stiffness_n_per_mm" in words


def test_a_case_is_matched_by_its_values_where_the_levels_differ(march, tmp_path):
    config = configuration()
    config["studies"][0]["factors"][0]["levels"] = [4.5, 5.0]
    fewer = write_run(
        tmp_path,
        C10,
        MARKS,
        config=config,
        changes={
            "cases.csv": lambda path: (
                pd.read_csv(path)
                .iloc[2:]
                .assign(case_id=[f"tested_{number:03d}" for number in range(1, 5)])
                .to_csv(path, index=False)
            )
        },
    )
    part = both(march, fewer).part("stiffness")
    found = part.table.set_index("case_a")
    assert found.loc["tested_003", "case_b"] == "tested_001"
    assert found[RESULT].tolist() == [Found.ONLY_A] * 2 + [Found.SAME] * 4
    assert "defines its cases differently in B" in part.remarks[0]


def test_missing_tables_and_columns_are_reported(march, tmp_path):
    def without_columns(path):
        pd.read_csv(path).drop(columns="effect").to_csv(path, index=False)

    poorer = write_run(
        tmp_path,
        C10,
        MARKS,
        changes={
            "response_impact.csv": without_columns,
            "decisions.csv": lambda path: path.unlink(),
        },
    )
    done = both(march, poorer)
    words = described(done.part("all_tables"))
    assert words == {
        "decisions.csv": "only in A",
        "response_impact.csv": "columns only in A: effect",
    }
    assert done.part("decisions").remarks == ("run B has no decisions.csv",)
    assert not done.same


def test_a_table_without_a_column_that_the_ranking_needs_is_reported(march, tmp_path):
    older = write_run(
        tmp_path,
        C10,
        MARKS,
        changes={
            "response_impact.csv": lambda path: (
                pd.read_csv(path).rename(columns={"rank": "place"}).to_csv(path, index=False)
            )
        },
    )
    part = both(march, older).part("ranking")
    assert part.remarks == ("response_impact.csv of run B has no column rank",)
    assert set(part.table[RESULT]) == {Found.ONLY_A}


def test_an_edited_table_is_named(march, tmp_path):
    shutil.copytree(march, tmp_path / "run")
    table = tmp_path / "run" / "results" / "tables" / "cases.csv"
    table.write_text(table.read_text("utf-8").replace("5000.0", "4999.0", 1), encoding="utf-8")
    with pytest.raises(InputError, match="changed after the run had written it") as refusal:
        read_run(tmp_path / "run", "B")
    assert "cases.csv" in str(refusal.value)


def test_an_edited_card_is_named(march, tmp_path):
    shutil.copytree(march, tmp_path / "run")
    file = tmp_path / "run" / "results" / "material_card.json"
    file.write_text(file.read_text("utf-8").replace("1.17", "1.18", 1), encoding="utf-8")
    with pytest.raises(InputError, match=r"material_card.json"):
        read_run(tmp_path / "run", "B")


def test_a_folder_without_a_run_is_refused(tmp_path, capsys):
    assert main(["compare", str(tmp_path), str(tmp_path)]) == 2
    assert "there is no finished run here" in capsys.readouterr().err


@pytest.mark.parametrize(
    "options",
    [["--k", "0"], ["--within", "-1"], ["--page", "x.pdf"], ["--workbook", "x.csv"]],
)
def test_wrong_arguments_are_refused_before_anything_is_read(options, tmp_path, capsys):
    assert main(["compare", str(tmp_path / "none"), str(tmp_path), *options]) == 2
    assert options[0] in capsys.readouterr().err


def test_a_run_that_does_not_exist_is_refused(march, tmp_path, capsys):
    assert main(["compare", str(march), str(tmp_path / "none")]) == 2
    assert "this run does not exist" in capsys.readouterr().err


def test_a_run_without_identity_is_compared_and_this_is_reported(march, tmp_path):
    older = write_run(tmp_path, C10, MARKS, identified=False)
    done = both(march, older)
    assert "without identity" in done.b
    assert done.part("inputs").remarks == (
        "run B has no identity: only the inputs that its folder still holds are known",
    )
    assert "no record of its software" in done.part("software").remarks[0]
    assert done.part("constants").same
    assert done.part("stiffness").same
    assert not done.same


def test_a_program_gets_every_row(march, april, capsys):
    assert main(["compare", str(march), str(april), "--json"]) == 1
    content = json.loads(capsys.readouterr().out)
    assert content["same"] is False
    rows = content["parts"]["stiffness"]["rows"]
    assert [row["result"] for row in rows] == ["same", "different"] * 3
    assert content["parts"]["constants"]["rows"][2]["b"] == 3.10


def test_the_terminal_shows_what_differs_and_nothing_else(march, april, capsys):
    assert main(["compare", str(march), str(april)]) == 1
    said = capsys.readouterr().out
    assert "SYNTHETIC" in said
    assert "c10_mpa of rubber_88A by +5.80 % (6.0 times the combined standard error)" in said
    assert "Configuration: " in said
    assert "rubber_75A-1.csv" not in said


def test_archives_are_compared_and_a_damaged_one_is_named(march, april, tmp_path, capsys):
    archives = [packed(run, tmp_path / f"{name}.zip") for name, run in
                (("a", march), ("b", april))]  # fmt: skip
    assert main(["compare", *map(str, archives)]) == 1
    assert "+5.80 %" in capsys.readouterr().out
    damaged = packed(april, tmp_path / "c.zip", {"results/tables/cases.csv": "study\n"})
    assert main(["compare", str(archives[0]), str(damaged)]) == 2
    said = capsys.readouterr().err
    assert "this archive was changed after it was packed" in said
    assert "results/tables/cases.csv: was changed" in said


def packed(run, target, changed=None):
    """Pack a run as `nptcs archive` does, without its code; change files behind the manifest."""
    import hashlib

    files = {
        path.relative_to(run).as_posix(): path.read_bytes()
        for path in sorted(run.rglob("*"))
        if path.is_file()
    }
    files["environment.json"] = b'{"python": "CPython 3.11", "packages": {"numpy": "2.4.6"}}'
    sums = {name: hashlib.sha256(data).hexdigest() for name, data in files.items()}
    graph = [{"@id": name, "sha256": digest} for name, digest in sums.items()]
    files["ro-crate-metadata.json"] = json.dumps({"@graph": graph}).encode()
    sums["ro-crate-metadata.json"] = hashlib.sha256(files["ro-crate-metadata.json"]).hexdigest()
    manifest = "".join(f"{digest}  {name}\n" for name, digest in sorted(sums.items()))
    with zipfile.ZipFile(target, "w") as archive:
        for name, data in {**files, "manifest-sha256.txt": manifest.encode()}.items():
            archive.writestr(name, (changed or {}).get(name, data))
    return target


def test_lists_of_named_things_are_compared_by_name():
    one = dict(flattened({"studies": [{"name": "x", "a": 1}, {"name": "y", "a": 2}]}))
    assert one["studies[y].a"] == "2"
    plain = dict(flattened({"levels": [1, 2], "empty": {}, "same": [{"name": "x"}, {"name": "x"}]}))
    assert plain["levels"] == "[1, 2]"
    assert plain["empty"] == "{}"
    assert plain["same"] == '[{"name": "x"}, {"name": "x"}]'


def test_another_code_or_configuration_is_another_identity(march, tmp_path):
    one = read_run(march, "A").identity
    shutil.copytree(march, tmp_path / "run")
    again = identify_run(tmp_path / "run" / "results", configuration(), day=20)
    other = identify_run(tmp_path / "run" / "results", configuration(load_n=4000.0))
    assert again.identity == one.identity
    assert again.made != one.made
    assert other.identity != one.identity
    named = {**configuration(), "report": {"title": "Another title"}}
    assert identify_run(tmp_path / "run" / "results", named).identity == one.identity


def test_identities_of_two_campaigns_differ(march, april):
    assert read_run(march, "A").identity.identity != read_run(april, "B").identity.identity
    assert OTHER_MARKS != MARKS
