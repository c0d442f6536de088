"""What shows that a specimen failed, and what does not: stopped, held, unloaded, broken ones."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pytest

from nptcs.reduce.groups.statistics import group_statistics

Make = Callable[..., Any]


def test_a_run_that_is_stopped_has_a_modulus_and_no_strength(bench: Any, run: Make) -> None:
    table, _, _ = run(bench.labcases / "stopped_before_failure", force_file="stopped.csv")
    assert table.loc["modulus", "value"] == pytest.approx(125760, rel=5e-4)
    assert table.loc["modulus", "range"] == "strain 0.001 to 0.003"
    bench.assert_not_assessed(table, bench.need_failure, "no failure seen")
    table, _, _ = run(bench.labcases / "stopped_before_failure", force_file="broken1.csv")
    assert table.loc["strength", "value"] == pytest.approx(24710.4 / 15, rel=1e-6)
    assert table.loc["ultimate_strain", "value"] == pytest.approx(0.012, rel=2e-3)


def test_unloading_is_not_failure(bench: Any, run: Make, tmp_path: Path) -> None:
    up, down = np.linspace(0, 0.0035, 200), np.linspace(0.0035, 0.0001, 120)
    strain = np.concatenate([up, down])
    name = bench.export(tmp_path, np.arange(320) * 0.2, bench.laminate(strain), strain)
    table, _, _ = run(tmp_path, force_file=name)
    bench.assert_not_assessed(table, bench.need_failure, "unloaded")
    assert table.loc["modulus", "value"] == pytest.approx(125000, rel=1e-3)


@pytest.mark.parametrize("rows_of_return", [4, 6, 12])
def test_a_quick_return_of_the_machine_is_not_failure(
    bench: Any, run: Make, tmp_path: Path, rows_of_return: int
) -> None:
    # loaded slowly, unloaded a hundred times as fast
    up, down = np.linspace(0, 0.0035, 600), np.linspace(0.0035, 0, rows_of_return + 2)[1:]
    strain = np.concatenate([up, down, np.zeros(5)])
    name = bench.export(tmp_path, np.arange(len(strain)) * 0.1, bench.laminate(strain), strain)
    table, _, _ = run(tmp_path, force_file=name)
    bench.assert_not_assessed(table, bench.need_failure, "no failure seen")
    assert table.loc["modulus", "value"] == pytest.approx(125000, rel=1e-3)


def test_a_break_that_takes_some_readings_is_failure(bench: Any, run: Make, tmp_path: Path) -> None:
    # the gauge stays on one half: its strain hardly moves while the force goes
    strain = np.concatenate([np.linspace(0, 0.012, 600), np.linspace(0.0119, 0.0112, 6)])
    force = bench.laminate(strain) * np.concatenate([np.ones(600), [0.9, 0.7, 0.5, 0.3, 0.1, 0.02]])
    name = bench.export(tmp_path, np.arange(606) * 0.1, force, strain)
    table, _, _ = run(tmp_path, force_file=name)
    assert table.loc["strength", "value"] == pytest.approx(1500, rel=1e-3)


@pytest.mark.parametrize(("readings", "spring_back"), [(8, 0.1), (15, 0.25), (20, 0.4)])
def test_a_gauge_that_springs_back_a_little_while_the_force_goes_is_on_a_broken_specimen(
    bench: Any, run: Make, tmp_path: Path, readings: int, spring_back: float
) -> None:
    course = np.linspace(0, 1, readings + 1)[1:]
    strain = np.concatenate([np.linspace(0, 0.012, 900), 0.012 * (1 - spring_back * course**2)])
    force = np.concatenate(
        [bench.laminate(strain[:900]), bench.laminate(0.012) * (1 - 0.9 * course)]
    )
    name = bench.export(tmp_path, np.arange(len(strain)) * 0.1, force, strain)
    table, _, _ = run(tmp_path, force_file=name)
    assert table.loc["strength", "value"] == pytest.approx(1500, rel=1e-3)
    assert table.loc["ultimate_strain", "value"] == pytest.approx(0.012, rel=1e-2)


@pytest.mark.parametrize("rows_of_return", [4, 8, 20])
@pytest.mark.parametrize("bend", [1.0, 3.0])
def test_a_quick_return_of_a_laminate_that_yielded_is_not_failure(
    bench: Any, run: Make, tmp_path: Path, rows_of_return: int, bend: float
) -> None:
    # it unloads as stiffly as it began to load, and keeps a set
    up = np.linspace(0, 0.012, 900)
    force = bench.laminate(0.012 / bend * np.tanh(up * bend / 0.012))
    down = np.linspace(1, 0, rows_of_return + 1)[1:]
    left = 0.012 - force[-1] / bench.laminate(1.0)
    strain = np.concatenate([up, left + (0.012 - left) * down])
    load = np.concatenate([force, force[-1] * down])
    name = bench.export(tmp_path, np.arange(len(strain)) * 0.1, load, strain)
    table, _, _ = run(tmp_path, force_file=name)
    bench.assert_not_assessed(table, bench.need_failure, "no failure seen")


@pytest.mark.parametrize("rows_of_return", [6, 10, 25])
@pytest.mark.parametrize(("power", "left"), [(2.0, 0.0), (3.5, 0.0), (2.5, 0.2)])
def test_a_quick_return_of_a_softened_specimen_is_not_failure(
    bench: Any, run: Make, tmp_path: Path, rows_of_return: int, power: float, left: float
) -> None:
    # a filled rubber or a foam: on the way back the force is gone long before the strain
    down = np.linspace(1, 0, rows_of_return + 1)[1:]
    strain = 0.012 * np.concatenate([np.linspace(0, 1, 900), down])
    share = np.clip((down - left) / (1 - left), 0, None) ** power
    force = bench.laminate(0.012) * np.concatenate([np.linspace(0, 1, 900), share])
    name = bench.export(tmp_path, np.arange(len(strain)) * 0.1, force, strain)
    table, _, _ = run(tmp_path, force_file=name)
    bench.assert_not_assessed(table, bench.need_failure, "no failure seen")


@pytest.mark.parametrize("rows_of_return", [6, 10, 25])
@pytest.mark.parametrize("readings", [1, 3])
def test_a_break_before_the_machine_returns_is_failure(
    bench: Any, run: Make, tmp_path: Path, rows_of_return: int, readings: int
) -> None:
    down = 0.012 * np.linspace(1, 0, rows_of_return + 1)[1:]
    strain = np.concatenate([np.linspace(0, 0.012, 900), np.full(readings + 2, 0.012), down])
    force = bench.laminate(strain)
    force[900:] = bench.laminate(0.012) * 0.02
    force[900 : 900 + readings] = bench.laminate(0.012) * np.linspace(0.6, 0.05, readings)
    name = bench.export(tmp_path, np.arange(len(strain)) * 0.1, force, strain)
    table, _, _ = run(tmp_path, force_file=name)
    assert table.loc["strength", "value"] == pytest.approx(1500, rel=1e-3)


def test_relaxation_at_a_held_strain_is_not_failure(bench: Any, run: Make, tmp_path: Path) -> None:
    up = np.linspace(0, 0.0035, 200)
    strain = np.concatenate([up, np.full(300, 0.0035)])
    force = bench.laminate(strain) * np.concatenate(
        [np.ones(200), 1 - 0.15 * np.linspace(0, 1, 300)]
    )
    name = bench.export(tmp_path, np.arange(500) * 0.2, force, strain)
    table, _, _ = run(tmp_path, force_file=name)
    bench.assert_not_assessed(table, bench.need_failure, "no failure seen")


def test_a_stopped_90_degree_test_does_not_use_the_rule_for_low_ultimate_strains(
    bench: Any, run: Make, tmp_path: Path
) -> None:
    strain = np.linspace(0, 0.0032, 300)
    name = bench.export(
        tmp_path, np.arange(300) * 0.2, 9000 * strain * (1 - 20 * strain) * 15, strain
    )
    table, _, _ = run(tmp_path, force_file=name, orientation_deg=90.0)
    assert table.loc["modulus", "range"] == "strain 0.001 to 0.003"
    assert "ultimate strain not known" in table.loc["modulus", "flags"]


def test_a_force_that_falls_while_the_strain_grows_is_failure(
    bench: Any, run: Make, tmp_path: Path
) -> None:
    strain = np.linspace(0, 0.02, 800)
    force = bench.laminate(np.minimum(strain, 0.012)) * np.clip(1 - 90 * (strain - 0.012), 0, 1)
    name = bench.export(tmp_path, np.arange(800) * 0.2, force, strain)
    table, _, _ = run(tmp_path, force_file=name)
    assert table.loc["strength", "value"] == pytest.approx(1500, rel=1e-2)
    assert table.loc["ultimate_strain", "value"] == pytest.approx(0.012, rel=1e-2)


def test_a_drop_of_a_fifth_at_the_end_of_the_record_is_failure(
    bench: Any, run: Make, tmp_path: Path
) -> None:
    # the machine stops recording as soon as it detects the break
    strain = np.append(np.linspace(0, 0.012, 400), 0.01201)
    force = np.append(bench.laminate(strain[:-1]), 0.8 * bench.laminate(0.012))
    name = bench.export(tmp_path, np.arange(401) * 0.2, force, strain)
    table, _, _ = run(tmp_path, force_file=name)
    assert table.loc["strength", "value"] == pytest.approx(1500, rel=1e-3)


def test_the_sheet_can_state_that_it_broke_or_that_it_was_stopped(bench: Any, run: Make) -> None:
    folder = bench.labcases / "stopped_before_failure"
    table, _, _ = run(folder, force_file="stopped.csv", failed=True)
    assert table.loc["strength", "value"] == pytest.approx(437.6, rel=1e-3)
    assert "failure as the sheet states it" in table.loc["strength", "flags"]
    table, _, _ = run(folder, force_file="broken1.csv", failed=False)
    bench.assert_not_assessed(table, bench.need_failure, "as the sheet states")


def test_a_compression_that_is_stopped_has_no_bending_at_failure(
    bench: Any, make_specimen: Make, make_curve: Make
) -> None:
    from nptcs.reduce import reduce_specimen

    strain = np.linspace(0, 0.004, 201)
    curve = make_curve(-strain, -1e5 * strain, strain_axial_back=-0.98 * strain)
    specimen = make_specimen("C-1", "compression", width_mm=(12.0,))
    table = reduce_specimen(curve, specimen, bench.settings, "strain_gauge").set_index("property")
    bench.assert_not_assessed(
        table, [*bench.need_failure, "bending_at_failure_percent"], "no failure seen"
    )
    assert np.isfinite(table.loc["bending_percent", "value"])


def test_a_shear_test_that_is_stopped_early_has_no_strength(
    bench: Any, make_specimen: Make, make_curve: Make
) -> None:
    from nptcs.reduce import reduce_specimen

    def shear(largest: float) -> pd.DataFrame:
        gamma = np.linspace(0, largest, 400)
        tau = 60 * np.tanh(3147 * gamma / 60)
        curve = make_curve(0.6 * gamma, 2 * tau, -0.4 * gamma)
        return reduce_specimen(
            curve, make_specimen("S-1", "shear"), bench.settings, "dic"
        ).set_index("property")

    bench.assert_not_assessed(
        shear(0.02), ["shear_strength", "ultimate_shear_strain"], "no failure seen"
    )
    # cut at 5 %, the standard's own end: no failure is needed
    assert shear(0.08).loc["shear_strength", "value"] == pytest.approx(60 * np.tanh(2.6225))


def test_no_mean_includes_a_stopped_run(bench: Any, run: Make, tmp_path: Path) -> None:
    tables, sheet = [], []
    for number in range(5):
        strain = np.linspace(0, 0.0134 + 1e-4 * number if number < 3 else 0.0035, 300)
        force = bench.laminate(strain)
        if number < 3:
            strain, force = np.append(strain, strain[-1]), np.append(force, 40.0)
        name = bench.export(tmp_path, np.arange(len(strain)) * 0.3, force, strain, f"{number}.csv")
        table, specimen, _ = run(tmp_path, f"T-{number}", force_file=name)
        tables.append(table.reset_index())
        sheet.append(specimen)
    table = group_statistics(
        pd.concat(tables)[[*tables[0].columns]], sheet, bench.settings
    ).set_index("property")
    assert table.loc["strength", "n"] == 3
    assert table.loc["strength", "mean"] == pytest.approx(125000 * 0.0135, rel=1e-3)
    assert table.loc["strength", "group_size"] == 5
    assert "T-3: no failure seen" in table.loc["strength", "not_assessed"]
    assert np.isnan(table.loc["strength", "b_basis"])
    assert table.loc["modulus", "n"] == 5
