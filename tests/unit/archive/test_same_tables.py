"""Two runs have the same tables only if every table, column, text and number agrees."""

import numpy as np
import pandas as pd
import pytest

from nptcs.archive.same_tables import compare_folders

TABLE = pd.DataFrame(
    {"case": ["a", "b"], "k": [1.0, np.nan], "ok": [True, False], "wall_time_s": [1.0, 2.0]}
)


def compared(folder, before, after):
    for name, tables in (("one", before), ("two", after)):
        (folder / name).mkdir()
        for file, table in tables.items():
            table.to_csv(folder / name / file, index=False)
    return compare_folders(folder / "one", folder / "two")


def test_wall_times_are_not_compared(tmp_path):
    found = compared(tmp_path, {"t.csv": TABLE}, {"t.csv": TABLE.assign(wall_time_s=9.0)})
    assert [table.same(0.0) for table in found] == [True]


@pytest.mark.parametrize(
    ("other", "said"),
    [
        (TABLE.assign(k=[1.1, np.nan]), "numbers differ by 9.1e-02"),
        (TABLE.assign(k=[1.0, 2.0]), "numbers differ by inf"),
        (TABLE.assign(case=["a", "c"]), "text of case differs"),
        (TABLE.assign(ok=[True, True]), "text of ok differs"),
        (TABLE.head(1), "different columns or rows"),
        (TABLE.rename(columns={"k": "m"}), "different columns or rows: ['k', 'm']"),
    ],
)
def test_each_difference_is_reported(tmp_path, other, said):
    found = compared(tmp_path, {"t.csv": TABLE}, {"t.csv": other})
    assert [table.same(1e-6) for table in found] == [False]
    assert said in str(found[0])


def test_a_table_of_one_run_only_is_a_difference(tmp_path):
    found = compared(tmp_path, {"t.csv": TABLE, "u.csv": TABLE}, {"t.csv": TABLE, "v.csv": TABLE})
    assert [table.same(0.0) for table in found] == [True, False, False]
