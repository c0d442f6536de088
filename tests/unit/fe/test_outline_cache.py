"""Outlines of a tyre are drawn once for everything that they depend on, and read from then on."""

from dataclasses import replace

import numpy as np
import pandas as pd
import pytest

from nptcs.fe import outline_cache
from nptcs.fe.outline_cache import DrawnCase, read_outlines, shared_outlines, write_outlines

ROWS = pd.DataFrame(
    {
        "part": ["spoke", "spoke", "band", "rim"],
        "outline": [0, 0, 1, 2],
        "x_mm": [0.1, -2.345, 300.0, 0.0],
        "y_mm": [1.0, 2.0, 3.0, -200.001],
        "x_undeformed_mm": [0.0, -2.0, 300.0, 0.0],
        "y_undeformed_mm": [1.5, 2.5, 3.5, -200.0],
    }
)
CASE = DrawnCase("a" * 64, {"shear_band_c10_mpa": 4.0}, 5000.0, None, None, {})


@pytest.fixture
def solved(monkeypatch):
    """The load of each tyre that was solved, where solving is replaced by `ROWS`."""
    loads = []

    def loaded(model, options, load_n):
        loads.append(load_n)

    for name in ("spoke_design", "shared_table", "tyre_model", "SpokeModel"):
        monkeypatch.setattr(outline_cache, name, lambda *_: None)
    monkeypatch.setattr(outline_cache, "loaded_tyre", loaded)
    monkeypatch.setattr(outline_cache, "tyre_outlines", lambda *_: ROWS.copy())
    return loads


def test_a_tyre_that_was_drawn_is_not_solved_again(solved, tmp_path):
    first = shared_outlines(CASE, tmp_path, None)
    again = shared_outlines(CASE, tmp_path, None)
    assert len(solved) == 1
    pd.testing.assert_frame_equal(first, again, check_dtype=False)
    pd.testing.assert_frame_equal(again, ROWS, check_dtype=False)


def test_another_case_or_other_code_is_drawn_anew(solved, tmp_path, monkeypatch):
    shared_outlines(CASE, tmp_path, None)
    shared_outlines(replace(CASE, key="b" * 64), tmp_path, None)
    assert len(solved) == 2
    monkeypatch.setattr(outline_cache, "code_hash", lambda _: "another")
    shared_outlines(CASE, tmp_path, None)
    assert len(solved) == 3


def test_a_damaged_file_is_drawn_anew(solved, tmp_path):
    shared_outlines(CASE, tmp_path, None)
    (file,) = tmp_path.iterdir()
    content = file.read_bytes()
    file.write_bytes(content[: len(content) // 2])
    pd.testing.assert_frame_equal(shared_outlines(CASE, tmp_path, None), ROWS, check_dtype=False)
    assert len(solved) == 2


def test_outlines_of_another_key_are_not_believed(tmp_path):
    write_outlines(tmp_path / "a.npz", "one", ROWS)
    assert read_outlines(tmp_path / "a.npz", "other") is None
    back = read_outlines(tmp_path / "a.npz", "one")
    assert back["part"].tolist() == ROWS["part"].tolist()
    np.testing.assert_array_equal(back.iloc[:, 2:].to_numpy(), ROWS.iloc[:, 2:].to_numpy())
