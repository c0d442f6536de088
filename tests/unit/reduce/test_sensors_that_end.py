"""Sensors that end before the force, and breaks between two frames."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pytest

from nptcs.reduce.groups.statistics import group_statistics

Make = Callable[..., Any]


@pytest.mark.parametrize(
    ("folder", "fields"),
    [
        ("extensometer_taken_off", {"force_file": "c2.csv"}),
        (
            "strain_record_ends_early",
            {"force_file": "c10_force.csv", "strain_file": "c10_strain.csv"},
        ),
    ],
)
def test_a_gauge_taken_off_before_failure(
    bench: Any, run: Make, folder: str, fields: dict[str, str]
) -> None:
    table, _, _ = run(bench.labcases / folder, width_mm=(10.0,), **fields)
    assert table.loc["modulus", "value"] == pytest.approx(100000, rel=1e-3)
    assert table.loc["strength", "value"] == pytest.approx(1998)
    assert "failure not recorded" in table.loc["strength", "flags"]
    bench.assert_not_assessed(table, ["ultimate_strain"], "strain recorded up to")
    bench.assert_not_assessed(table, ["time_to_failure"], "failure not recorded")


@pytest.mark.parametrize(("stated", "count"), [(None, 2), (True, 3), (False, 2)])
def test_no_mean_includes_a_failure_that_no_reading_shows(
    bench: Any, run: Make, tmp_path: Path, stated: bool | None, count: int
) -> None:
    """Two that break, and one whose gauge is taken off and whose record ends at the top."""
    strain = np.linspace(0, 0.012, 600)
    tables, sheet = [], []
    for number in range(3):
        force, seen = bench.laminate(strain * (1 + 0.01 * number)), strain.copy()
        if number == 2:
            seen[240:] = -0.03
        else:
            force, seen = np.append(force, 10.0), np.append(seen, 0.0)
        name = bench.export(tmp_path, np.arange(len(force)) * 0.2, force, seen, f"{number}.csv")
        fields = {"failed": stated} if number == 2 else {}
        table, specimen, _ = run(tmp_path, f"T-{number}", force_file=name, **fields)
        tables.append(table.reset_index())
        sheet.append(specimen)
    found = group_statistics(pd.concat(tables)[[*tables[0].columns]], sheet, bench.settings)
    strength = found.set_index("property").loc["strength"]
    assert (strength["n"], strength["group_size"]) == (count, 3)
    if stated is None:
        assert "T-2: failure not recorded" in strength["not_assessed"]
        assert tables[2].set_index("property").loc["strength", "value"] > 1500


@pytest.mark.parametrize("leaves_at", [0.85, 0.97])
def test_a_gauge_taken_off_near_the_end_does_not_imply_failure(
    bench: Any, run: Make, tmp_path: Path, leaves_at: float
) -> None:
    """A modulus run whose gauge is taken off where it is stopped."""
    strain = np.linspace(0, 0.0045, 500)
    seen = np.where(np.arange(500) < leaves_at * 500, strain, -0.03)
    name = bench.export(tmp_path, np.arange(500) * 0.2, bench.laminate(strain), seen)
    table, _, _ = run(tmp_path, force_file=name)
    bench.assert_not_assessed(table, ["strength"], "no failure seen")


def test_a_gauge_taken_off_before_a_hold_does_not_imply_failure(
    bench: Any, run: Make, tmp_path: Path
) -> None:
    strain = np.append(np.linspace(0, 0.006, 400), np.linspace(0.006, 0.00601, 200))
    seen = np.where(np.arange(600) < 200, strain, -0.03)
    name = bench.export(tmp_path, np.arange(600) * 0.2, bench.laminate(strain), seen)
    table, _, _ = run(tmp_path, force_file=name)
    bench.assert_not_assessed(table, ["strength"], "no failure seen")


@pytest.mark.parametrize("stuck_at", [0.00252, 0.00299, 0.00305])
def test_a_gauge_that_stands_still_near_the_end_of_the_chord(
    bench: Any, run: Make, tmp_path: Path, stuck_at: float
) -> None:
    strain = np.linspace(0, 0.0045, 700)
    random = np.random.default_rng(2)
    seen = np.minimum(strain, stuck_at) + 1e-7 * random.standard_normal(700)
    name = bench.export(tmp_path, np.arange(700) * 0.2, bench.laminate(strain), seen)
    table, _, _ = run(tmp_path, force_file=name)
    assert table.loc["modulus", "value"] == pytest.approx(125000, rel=2e-3)


def test_no_strain_is_interpolated_across_a_break(bench: Any, run: Make) -> None:
    table, _, _ = run(
        bench.labcases / "break_between_frames",
        force_file="c1_machine.csv",
        strain_file="c1_camera.csv",
        width_mm=(10.0,),
    )
    assert 0.0120 - 1e-9 <= table.loc["ultimate_strain", "value"] <= 0.01204 + 1e-9


@pytest.mark.parametrize(("period_s", "broken_at_s"), [(2.0, 61.3), (0.5, 60.2)])
def test_no_strain_is_interpolated_across_a_break_at_other_rates(
    run: Make, tmp_path: Path, period_s: float, broken_at_s: float
) -> None:
    fast = np.arange(0, broken_at_s + 3, 0.02)
    force = np.where(fast <= broken_at_s, 300 * fast, 0.0)
    pd.DataFrame({"Time [s]": fast, "Load [N]": force}).to_csv(tmp_path / "m.csv", index=False)
    frames = np.arange(0, broken_at_s + 3, period_s)
    seen = np.where(frames <= broken_at_s, 0.02 * frames, 0.05)
    camera = {"Time [s]": frames, "Load [N]": np.interp(frames, fast, force), "Strain [%]": seen}
    pd.DataFrame(camera).to_csv(tmp_path / "c.csv", index=False)
    table, _, _ = run(tmp_path, force_file="m.csv", strain_file="c.csv")
    last = 2e-4 * frames[frames <= broken_at_s].max()
    assert last - 1e-9 <= table.loc["ultimate_strain", "value"] <= 2.001e-4 * broken_at_s
