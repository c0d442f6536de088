"""`new-sheet` for several runs on one piece: one piece, whatever the runs are called."""

from __future__ import annotations

import numpy as np
import pytest

from nptcs.ingest.new_sheet import propose_sheet
from nptcs.ingest.runs_of_pieces import piece_of

TIME = np.arange(0, 30.0, 0.5)
FORCE = 240 * TIME


def folder_of(lab, tmp_path, names, table=""):
    for number, name in enumerate(names):
        path = tmp_path / name
        path.parent.mkdir(exist_ok=True)
        columns = {"Time (s)": TIME, "Load (N)": (1 + 0.01 * number) * FORCE}
        lab.write(path, columns | {"Strain (%)": 0.02 * TIME})
    if table:
        (tmp_path / "dimensions.csv").write_text(table)
    return tmp_path


@pytest.mark.parametrize(
    ("name", "piece"),
    [
        ("S1_run1", "S1"), ("S1_run_02", "S1"), ("UD-3 Lauf 2", "UD-3"), ("A7_rupture", "A7"),
        ("A7_E-Modul", "A7"), ("B2.break", "B2"), ("run1", ""), ("S1", ""), ("S1_2", ""),
        ("brunch1", ""),
    ],
)  # fmt: skip
def test_a_run_is_recognised_by_its_name(name, piece):
    assert piece_of(name) == piece


def test_runs_of_a_piece_share_its_name_and_its_dimensions(lab, profiles, tmp_path):
    names = [f"UD{k}_run{n}.csv" for k in (1, 2) for n in (1, 2)]
    folder = folder_of(lab, tmp_path, names, "Specimen,Width,Thickness\nUD1,10,1\nUD2,11,1.1\n")
    proposal = propose_sheet(folder, profiles)
    assert [row["piece"] for row in proposal.rows] == ["UD1", "UD1", "UD2", "UD2"]
    assert [row["width_mm"] for row in proposal.rows] == ["10", "10", "11", "11"]
    assert all("state in properties what counts" in row["remarks"] for row in proposal.rows)
    assert list(proposal.open_series()) == ["UD"]


def test_what_counts_is_proposed_where_the_names_say_it(lab, profiles, tmp_path):
    names = ["zug/T1_modulus.csv", "zug/T1_rupture.csv", "zug/T2.csv", "zug/T2_rupture.csv"]
    proposal = propose_sheet(folder_of(lab, tmp_path, names), profiles)
    rows = {row["specimen"]: row for row in proposal.rows}
    assert rows["T1_modulus"]["properties"] == "modulus;poisson_ratio"
    assert rows["T1_rupture"]["properties"] == "strength;ultimate_strain"
    assert rows["T2"]["piece"] == rows["T2_rupture"]["piece"] == "T2"
    assert not rows["T2"].get("properties")


def test_runs_without_a_numbered_piece_may_be_specimens(lab, profiles, tmp_path):
    folder = folder_of(lab, tmp_path, [f"tension_run{n}.csv" for n in (1, 2, 3)])
    assert not any(row.get("piece") for row in propose_sheet(folder, profiles).rows)
