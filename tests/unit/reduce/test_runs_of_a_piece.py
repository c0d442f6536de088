"""Runs of one piece: the modulus from one, the strength from another."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pytest

from nptcs.reduce.groups.statistics import group_statistics

Make = Callable[..., Any]


def runs_of_a_piece(run: Make, folder: Path, number: int) -> tuple[list[pd.DataFrame], list[Any]]:
    tables, sheet = [], []
    piece = f"P-{number}"
    for name, given in (("modulus", ("modulus",)), ("rupture", ("strength",))):
        table, specimen, _ = run(
            folder,
            f"{piece}-{name}",
            force_file=f"{number}_{name}.csv",
            piece=piece,
            properties=given,
        )
        tables.append(table.reset_index())
        sheet.append(specimen)
    return tables, sheet


def test_a_piece_takes_its_modulus_from_one_run_and_its_strength_from_another(
    bench: Any, run: Make, tmp_path: Path
) -> None:
    tables, sheet = [], []
    for number in range(3):
        strain = np.linspace(0, 0.0035, 200)
        bench.export(
            tmp_path,
            np.arange(200) * 0.2,
            bench.laminate(strain, 50000),
            strain,
            f"{number}_modulus.csv",
        )
        # the rupture run has a travel-like strain, half as stiff, and breaks
        strain = np.append(np.linspace(0, 0.026, 300), 0.026)
        force = np.append(bench.laminate(strain[:-1], 25000), 60.0)
        bench.export(tmp_path, np.arange(301) * 0.2, force, strain, f"{number}_rupture.csv")
        more, rows = runs_of_a_piece(run, tmp_path, number)
        tables += more
        sheet += rows
    table = group_statistics(pd.concat(tables), sheet, bench.settings).set_index("property")
    assert table.loc["modulus", ["n", "group_size"]].tolist() == [3, 3]
    assert table.loc["modulus", "mean"] == pytest.approx(50000, rel=1e-3)
    assert table.loc["strength", "n"] == 3
    assert table.loc["strength", "mean"] == pytest.approx(650, rel=1e-3)
    assert "P-0-rupture: the sheet takes other properties" in table.loc["modulus", "left_out"]


def test_the_modulus_run_and_the_rupture_of_one_piece(bench: Any, run: Make) -> None:
    folder = bench.labcases / "modulus_runs_and_rupture"
    fields = {"width_mm": (30.0,), "piece": "P"}
    tables, sheet = [], []
    for name, file, given, length in (
        ("P-run1", "run1.dat", ("modulus",), None),
        ("P-rupture", "rupture.dat", ("strength",), 100.0),
    ):
        own = {"force_file": file, "properties": given, "gauge_length_mm": length}
        table, specimen, _ = run(folder, name, **fields, **own)
        tables.append(table.reset_index())
        sheet.append(specimen)
    # the run ends at 0.25 %: the range is another one, and says so
    row = tables[0].set_index("property").loc["modulus"]
    assert row["range"] == "strain 0.0005 to 0.0025"
    assert "strain ends at 0.0025: chord over another range" in row["flags"]
    table = group_statistics(pd.concat(tables), sheet, bench.settings).set_index("property")
    assert table.loc["modulus", ["n", "mean"]].tolist() == pytest.approx([1, 50000], rel=1e-3)
    assert table.loc["strength", ["n", "mean"]].tolist() == pytest.approx([1, 650], rel=1e-6)


def test_runs_that_give_the_same_property_count_once(bench: Any, make_specimen: Make) -> None:
    rows = [("A-1", "A", 10.0), ("A-2", "A", 12.0), ("B-1", "", 20.0)]
    sheet = [make_specimen(name, piece=piece) for name, piece, _ in rows]
    table = pd.DataFrame(
        [
            {
                "specimen": name,
                "test": "tension",
                "material": "cfrp",
                "property": "modulus",
                "value": value,
                "unit": "MPa",
                "rule": "r",
                "range": "",
                "points": 2,
                "flags": "",
                "orientation_deg": 0.0,
                "r_squared": np.nan,
                "standard_error": np.nan,
                "origin": "measured",
                "range_low": np.nan,
                "range_high": np.nan,
                "origin_effect_percent": np.nan,
            }
            for name, _, value in rows
        ]
    )
    row = group_statistics(table, sheet, bench.settings).iloc[0]
    assert (row["n"], row["mean"]) == (2, 15.5)


def test_a_row_that_names_a_property_of_another_test_is_refused(make_specimen: Make) -> None:
    with pytest.raises(ValueError, match="properties names 'shear_modulus', but a tension test"):
        make_specimen(properties=("shear_modulus",))
    assert make_specimen("R", "rubber_tension", properties=("stress_at_150_percent",))
