"""Tests of known truth whose record changes in the middle: right, not assessed or refused.

A value that is given must be the true one; what must not be given is named for each.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from written_exports import E_MPA, FULL, export, reduced

from nptcs.errors import InputError

RANDOM = np.random.default_rng(11)
UP = np.linspace(0, 0.012, 600)
CLOCK = np.arange(608) / 10
STRAIN = np.append(UP, np.full(8, 0.004))
FORCE = np.append(E_MPA * 10 * UP, np.full(8, 15.0)) + RANDOM.standard_normal(608)
NEITHER = {"strength", "ultimate_strain"}


def written(force: Any = FORCE, strain: Any = STRAIN, time: Any = None) -> str:
    time = np.arange(len(force)) / 10 if time is None else time
    return export({"Time [s]": time, "Force [N]": force, "Strain [%]": 100 * strain})


def replaced(array: Any, rows: slice, values: Any) -> Any:
    changed = array.copy()
    changed[rows] = values
    return changed


def cells(rows: range, place: int, word: str) -> str:
    """Replace cells of the table by a word."""
    lines = written().splitlines()
    for row in rows:
        parts = lines[row].split(",")
        parts[place] = word
        lines[row] = ",".join(parts)
    return "\n".join(lines) + "\n"


def cycle_before(depth: float) -> str:
    strain = np.concatenate([np.linspace(0, depth, 150), np.linspace(depth, 0, 150), UP])
    force = np.append(E_MPA * 10 * strain, np.full(8, 15.0)) + RANDOM.standard_normal(908)
    return written(force, np.append(strain, np.full(8, 0.003)))


def grouped(value: float, digits: int) -> str:
    return f"{value:,.{digits}f}".replace(",", "_").replace(".", ",").replace("_", ".")


def in_german() -> str:
    rows = zip(CLOCK, FORCE, 100 * STRAIN, strict=True)
    body = (f"{grouped(t, 2)};{grouped(f, 1)};{grouped(e, 5)}" for t, f, e in rows)
    return "\n".join(["Zeit [s];Kraft [N];Dehnung [%]", *body]) + "\n"


def under(units: list[str], force: Any, strain: Any) -> str:
    return export({"Time": CLOCK, "Force": force, "Strain": strain}, ";", ",", units)


half = written().splitlines()
TARED = replaced(FORCE, slice(200, 600), FORCE[200:600] - FORCE[200])
CASES: dict[str, tuple[str, set[str]]] = {
    "load cell tared in mid-test": (written(TARED), NEITHER),
    "load cell tared at three quarters": (
        written(replaced(FORCE, slice(450, 600), FORCE[450:600] - FORCE[450])), NEITHER),
    "range of the force switched down": (
        written(replaced(FORCE, slice(400, 608), FORCE[400:] / 10)), NEITHER),
    "range of the force switched to kN": (
        written(replaced(FORCE, slice(300, 608), FORCE[300:] / 1e3)), NEITHER),
    "range of the force switched up": (
        written(replaced(FORCE, slice(300, 608), FORCE[300:] * 10)), NEITHER),
    "range of the strain switched": (
        written(strain=replaced(STRAIN, slice(200, 608), 10 * STRAIN[200:])), {"ultimate_strain"}),
    "strain of the other sign from the middle": (
        written(strain=replaced(STRAIN, slice(300, 600), -UP[300:])), {"ultimate_strain"}),
    "gauge off just before the peak": (
        written(strain=replaced(STRAIN, slice(582, 608), -0.02)), {"ultimate_strain"}),
    "gauge slides back": (
        written(strain=replaced(STRAIN, slice(540, 600), UP[540] - 2e-5 * np.arange(60))),
        {"ultimate_strain"}),
    "gauge set to zero within the range of the modulus": (
        written(strain=replaced(STRAIN, slice(75, 600), UP[75:] - UP[75])),
        {"modulus", "ultimate_strain"}),
    "strain not set to zero": (written(strain=0.002 + STRAIN), set()),
    "a cycle in compression, then the pull": (cycle_before(-0.003), set()),
    "a cycle in tension, then the pull": (cycle_before(0.003), set()),
    "the clock goes back": (
        written(time=replaced(CLOCK, slice(300, 608), CLOCK[300:] - 20)), set()),
    "each row written twice": (
        written(*(np.repeat(x, 2) for x in (FORCE, STRAIN, CLOCK))), set()),
    "the second half pasted twice": ("\n".join([*half, *half[300:]]) + "\n", set()),
    "the names again in the middle": ("\n".join([*half[:301], half[0], *half[301:]]) + "\n", set()),
    "9.9E37 in the strain from 80 %": (cells(range(500, 605), 2, "9.9E37"), {"ultimate_strain"}),
    "9.9E37 in the force": (cells(range(200, 450, 120), 1, "9.90E+37"), set()),
    "-9999 for 40 readings": (cells(range(300, 340), 2, "-9999"), {"ultimate_strain"}),
    "words for no value": (cells(range(50, 600, 37), 2, "#DIV/0!"), set()),
    "thousands in points": (in_german(), set()),
    "units in Russian": (under(["с", "кН", "%"], FORCE / 1e3, 100 * STRAIN), set()),
    "units in German words": (
        under(["Sekunden", "Kilonewton", "Prozent"], FORCE / 1e3, 100 * STRAIN), set()),
    "units in Japanese words": (
        under(["秒", "ニュートン", "マイクロひずみ"], FORCE, 1e6 * STRAIN), set()),
}  # fmt: skip


@pytest.mark.parametrize("name", CASES)
def test_what_changes_in_the_record_gives_no_wrong_value(tmp_path, profiles, name):
    content, lost = CASES[name]
    table, record = reduced(tmp_path, profiles, content)
    for key, value in FULL.items():
        given = table.loc[key, "value"]
        assert np.isnan(given) == (key in lost), (key, given, record.flags)
        assert np.isnan(given) or given == pytest.approx(value, rel=0.03), (key, record.flags)


@pytest.mark.parametrize(
    ("content", "words"),
    [
        (cells(range(50, 600, 37), 2, "OVER"), "not a number"),
        (written(strain=1e3 * STRAIN), "beyond 0.5"),
        (written(FORCE / 1e3), "apparent modulus 120 MPa"),
    ],
)
def test_what_cannot_be_is_refused(tmp_path, profiles, content, words):
    with pytest.raises(InputError, match=words):
        reduced(tmp_path, profiles, content)


@pytest.mark.parametrize("share", [0.3, 0.5, 0.8])
def test_a_specimen_that_broke_in_part_is_not_a_load_cell_set_to_zero(tmp_path, profiles, share):
    force = replaced(FORCE, slice(350, 600), share * FORCE[350:600])
    table, record = reduced(tmp_path, profiles, written(force))
    assert not any("leaps" in flag for flag in record.flags)
    assert table.loc["modulus", "value"] == pytest.approx(E_MPA, rel=0.02)


@pytest.mark.parametrize("readings", [25, 40, 80])
def test_a_slow_logger_is_not_a_load_cell_set_to_zero(tmp_path, profiles, readings):
    # between two readings the force grows by more than a tenth of what it was
    strain = np.linspace(0, 0.012, readings)
    force = np.append(E_MPA * 10 * strain, [15.0, 14.0, 15.0])
    _, record = reduced(tmp_path, profiles, written(force, np.append(strain, [0.004] * 3)))
    assert not any("leaps" in flag for flag in record.flags)
