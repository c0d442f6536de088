"""Cyclic tests: loadings are found and counted, and the sheet chooses one."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from nptcs.calibrate import c10_against_range, calibrate_rubber
from nptcs.config.materials.calibration import CalibrationSettings
from nptcs.errors import InputError
from nptcs.loading import judge_failure, loadings
from nptcs.tables.laboratory.specimens import Specimen

Make = Callable[..., Any]


def neo_hooke(strain: Any, c10: float) -> Any:
    stretch = 1 + np.asarray(strain)
    return 2 * c10 * (stretch - stretch**-2)


def fit(done: Any, specimen: Specimen) -> tuple[float, str]:
    card = calibrate_rubber(
        specimen.material, {specimen.specimen: done.curve}, [specimen], CalibrationSettings()
    )
    return card.constants["c10_mpa"].value, "; ".join(card.checks)


@pytest.mark.parametrize(
    ("loading", "c10", "words"),
    [
        ("first", 1.0, "the first taken"),
        ("2", 0.7, "number 2 taken"),
        ("last", 0.7, "number 4 taken"),
        ("envelope", 1.0, "their envelope taken"),
    ],
)
def test_the_sheet_chooses_the_loading_of_a_cyclic_test(
    bench: Any, run: Make, loading: str, c10: float, words: str
) -> None:
    fields = {"force_file": "rub_cyc3.csv", "loading": loading}
    table, specimen, done = run(bench.labcases / "cyclic_rubber", "R-1", "rubber_tension", **fields)
    value, checks = fit(done, specimen)
    assert value == pytest.approx(c10, rel=2e-3)
    assert f"4 loadings in the record, {words}" in checks
    assert f"4 loadings in the record, {words}" in table.loc["strain_rate", "flags"]


def test_a_cyclic_test_is_in_the_table_of_ranges(bench: Any, run: Make) -> None:
    _, specimen, done = run(
        bench.labcases / "cyclic_rubber", "R-1", "rubber_tension", force_file="rub_cyc3.csv"
    )
    curves, material = {"R-1": done.curve}, specimen.material
    table = c10_against_range(material, curves, [specimen], CalibrationSettings())
    row = table[(table["specimen"] == "R-1") & table["in_card"]].iloc[0]
    assert row["c10_mpa"] == pytest.approx(1.0, rel=2e-3)
    assert "4 loadings in the record" in row["remarks"]
    # the first loading ends at 20 %
    beyond = table[(table["specimen"] == "R-1") & (table["strain_high"] == 0.5)].iloc[0]
    assert np.isnan(beyond["c10_mpa"])


def test_two_runs_of_a_piece_in_one_fit_are_reported(bench: Any, run: Make) -> None:
    folder, curves, sheet = bench.labcases / "cyclic_rubber", {}, []
    for name, file in (("R-1", "rub_cyc3.csv"), ("R-2", "rub_mono.csv")):
        _, specimen, done = run(folder, name, "rubber_tension", force_file=file, piece="R")
        curves[name], sheet = done.curve, [*sheet, specimen]
    card = calibrate_rubber(sheet[0].material, curves, sheet, CalibrationSettings())
    assert any("2 runs of R are in the fit" in check for check in card.checks)


def test_a_loading_that_the_record_lacks_is_an_error(bench: Any, run: Make) -> None:
    fields = {"force_file": "rub_cyc3.csv", "loading": "5"}
    with pytest.raises(InputError, match=r"R-1.*the record has 4 loadings"):
        run(bench.labcases / "cyclic_rubber", "R-1", "rubber_tension", **fields)
    with pytest.raises(InputError, match="the record has 1 loading "):
        run(
            bench.labcases / "cyclic_rubber",
            "R-1",
            "rubber_tension",
            force_file="rub_mono.csv",
            loading="2",
        )


def cycles_with_set(c10s: list[float], top: float, left: float) -> tuple[Any, Any]:
    """Strain and stress of loadings that each leave a set; each is neo-Hookean from its set."""
    strain, stress = [], []
    for number, c10 in enumerate(c10s):
        begin = left * number
        up = np.linspace(begin, top, 150)
        own = (up - begin) / (1 + begin)
        down = np.linspace(top, left * (number + 1), 100)[1:]
        back = (down - down[-1]) / (1 + down[-1])
        strain += [up, down]
        stress += [neo_hooke(own, c10) / (1 + begin), neo_hooke(back, 0.8 * c10)]
    return np.concatenate(strain), np.concatenate(stress)


@pytest.mark.parametrize(("loading", "c10"), [("first", 1.0), ("3", 0.75), ("last", 0.7)])
def test_the_set_of_earlier_cycles_is_taken_off_a_later_one(
    bench: Any, run: Make, tmp_path: Path, loading: str, c10: float
) -> None:
    strain, stress = cycles_with_set([1.0, 0.85, 0.75, 0.7], 0.5, 0.01)
    name = bench.export(tmp_path, np.arange(len(strain)) * 0.1, 12 * stress, strain)
    table, specimen, done = run(tmp_path, "R-1", "rubber_tension", force_file=name, loading=loading)
    value, checks = fit(done, specimen)
    assert value == pytest.approx(c10, rel=0.02)
    assert "4 loadings" in checks
    assert ("the set of" in checks) == (loading != "first")


def test_modulus_cycles_of_a_laminate_and_the_pull_that_breaks_it(
    bench: Any, run: Make, tmp_path: Path
) -> None:
    course = [0, 0.004, 0.0005, 0.004, 0.0005, 0.0122]
    strain = np.concatenate(
        [np.linspace(a, b, 150)[1:] for a, b in zip(course, course[1:], strict=False)]
    )
    # stiffer by 3 % in the first loading than afterwards
    force = bench.laminate(strain) * np.where(np.arange(len(strain)) < 149, 1.03, 1.0)
    strain, force = np.append(strain, strain[-1]), np.append(force, 10.0)
    name = bench.export(tmp_path, np.arange(len(strain)) * 0.2, force, strain)
    table, _, _ = run(tmp_path, force_file=name)
    assert table.loc["modulus", "value"] == pytest.approx(1.03 * 125000, rel=2e-3)
    assert table.loc["strength", "value"] == pytest.approx(125000 * 0.0122, rel=1e-3)
    assert "3 loadings in the record, the first taken" in table.loc["modulus", "flags"]
    table, _, _ = run(tmp_path, force_file=name, loading="last")
    assert table.loc["modulus", "value"] == pytest.approx(125000, rel=2e-3)


def test_the_energy_is_that_of_the_loading_that_broke(
    bench: Any, make_specimen: Make, make_curve: Make
) -> None:
    from nptcs.reduce import reduce_specimen

    first, second = np.linspace(0, 0.5, 100), np.linspace(0, 2.0, 300)
    strain = np.concatenate([first, first[::-1], second])
    curve = make_curve(strain, neo_hooke(strain, 1.0))

    def energy(loading: str) -> Any:
        specimen = make_specimen("R-1", "rubber_tension", loading=loading)
        table = reduce_specimen(curve, specimen, bench.settings, failure_seen=True)
        return table.set_index("property").loc["strain_energy_density"]

    exact = 1.0 * (3.0**2 + 2 / 3.0 - 3)
    assert energy("last")["value"] == pytest.approx(exact, rel=1e-3)
    assert energy("envelope")["value"] == pytest.approx(exact, rel=2e-3)
    assert "not the one that broke" in energy("first")["flags"]


@pytest.mark.parametrize("noise", [0.0, 2e-5])
def test_serrations_noise_and_slips_are_not_loadings(noise: float) -> None:
    random = np.random.default_rng(3)
    strain = np.linspace(0, 0.012, 500) + noise * random.standard_normal(500)
    force = 1e5 * np.linspace(0, 0.012, 500)
    assert len(loadings(force, strain)) == 1
    serrated = force * np.where(np.arange(500) % 50 < 5, 0.7, 1.0)
    assert len(loadings(serrated, strain)) == 1
    slipped = strain - 0.004 * (np.arange(500) > 250)
    assert len(loadings(force, slipped)) == 1


def test_cycles_without_a_strain_are_found_in_the_force() -> None:
    ramp = np.linspace(0, 1, 60)
    force = np.concatenate([ramp, ramp[::-1], ramp, ramp[::-1], 2 * ramp])
    found = loadings(force, np.full(300, np.nan))
    assert len(found) == 3
    assert [force[loading.stop - 1] for loading in found] == [1.0, 1.0, 2.0]


def test_failure_is_judged_in_words() -> None:
    up = np.linspace(0, 1, 100)
    nothing = np.full(101, np.nan)
    assert "never falls by 10 %" in judge_failure(up, up).words
    assert judge_failure(np.append(up, 0.2), nothing).seen
    slow = np.concatenate([up, np.linspace(1, 0.5, 100)])
    assert not judge_failure(slow, np.full(200, np.nan)).seen
    assert "no load" in judge_failure(np.zeros(5), np.zeros(5)).words
