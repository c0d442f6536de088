"""What a test shows and what it does not: stopped tests, cyclic tests, breaks, runs of one piece.

The labcases are the smallest inputs that once went wrong; next to each are inputs of the same kind.
"""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pytest

from nptcs.calibrate import c10_against_range, calibrate_rubber
from nptcs.config.calibration import CalibrationSettings
from nptcs.config.ingest import IngestSettings
from nptcs.config.reduction import ReductionSettings
from nptcs.errors import InputError
from nptcs.ingest import Ingested, ingest_specimen, load_profiles
from nptcs.loading import judge_failure, loadings
from nptcs.reduce import reduce_record
from nptcs.reduce.statistics import group_statistics
from nptcs.tables.specimens import Specimen

Make = Callable[..., Any]
ROOT = Path(__file__).resolve().parents[3]
LABCASES = ROOT / "tests" / "unit" / "labcases"
SETTINGS = ReductionSettings()
NEED_FAILURE = ["strength", "ultimate_strain", "time_to_failure"]


@pytest.fixture(scope="module")
def profiles() -> Any:
    return load_profiles(ROOT / "config" / "formats")


@pytest.fixture
def run(profiles: Any, make_specimen: Make) -> Callable[..., tuple[pd.DataFrame, Specimen, Any]]:
    """Ingest and reduce a file: the properties by name, the specimen, what the ingest made."""

    def go(folder: Path, name: str = "X-1", test: str = "tension", **fields: Any) -> Any:
        specimen = make_specimen(name, test, **fields)
        done: Ingested = ingest_specimen(specimen, folder, IngestSettings(), profiles)
        table = reduce_record(done.curve, specimen, done.record, SETTINGS)
        return table.set_index("property"), specimen, done

    return go


def export(folder: Path, time: Any, force: Any, strain: Any, name: str = "raw.csv") -> str:
    """Write a plain export: time in s, force in N, strain in %."""
    table = {"Time (s)": time, "Load (N)": force, "Axial strain (%)": 100 * np.asarray(strain)}
    pd.DataFrame(table).to_csv(folder / name, index=False, float_format="%.8g")
    return name


def laminate(strain: Any, modulus: float = 125000.0, area: float = 15.0) -> Any:
    return modulus * np.asarray(strain) * area


def assert_not_assessed(table: pd.DataFrame, names: list[str], words: str) -> None:
    for name in names:
        assert np.isnan(table.loc[name, "value"]), name
        assert "not assessed: " in table.loc[name, "flags"], name
        assert words in table.loc[name, "flags"], (name, table.loc[name, "flags"])


# --- stopped before failure ------------------------------------------------------------------


def test_a_run_that_is_stopped_has_a_modulus_and_no_strength(run: Make) -> None:
    table, _, _ = run(LABCASES / "stopped_before_failure", force_file="stopped.csv")
    assert table.loc["modulus", "value"] == pytest.approx(125760, rel=5e-4)
    assert table.loc["modulus", "range"] == "strain 0.001 to 0.003"
    assert_not_assessed(table, NEED_FAILURE, "no failure seen")
    table, _, _ = run(LABCASES / "stopped_before_failure", force_file="broken1.csv")
    assert table.loc["strength", "value"] == pytest.approx(24710.4 / 15, rel=1e-6)
    assert table.loc["ultimate_strain", "value"] == pytest.approx(0.012, rel=2e-3)


def test_unloading_is_no_failure(run: Make, tmp_path: Path) -> None:
    up, down = np.linspace(0, 0.0035, 200), np.linspace(0.0035, 0.0001, 120)
    strain = np.concatenate([up, down])
    name = export(tmp_path, np.arange(320) * 0.2, laminate(strain), strain)
    table, _, _ = run(tmp_path, force_file=name)
    assert_not_assessed(table, NEED_FAILURE, "unloaded")
    assert table.loc["modulus", "value"] == pytest.approx(125000, rel=1e-3)


@pytest.mark.parametrize("rows_of_return", [4, 6, 12])
def test_a_quick_return_of_the_machine_is_no_failure(
    run: Make, tmp_path: Path, rows_of_return: int
) -> None:
    # loaded slowly, unloaded a hundred times as fast
    up, down = np.linspace(0, 0.0035, 600), np.linspace(0.0035, 0, rows_of_return + 2)[1:]
    strain = np.concatenate([up, down, np.zeros(5)])
    name = export(tmp_path, np.arange(len(strain)) * 0.1, laminate(strain), strain)
    table, _, _ = run(tmp_path, force_file=name)
    assert_not_assessed(table, NEED_FAILURE, "no failure seen")
    assert table.loc["modulus", "value"] == pytest.approx(125000, rel=1e-3)


def test_a_break_that_takes_some_readings_is_failure(run: Make, tmp_path: Path) -> None:
    # the gauge stays on one half: its strain hardly moves while the force goes
    strain = np.concatenate([np.linspace(0, 0.012, 600), np.linspace(0.0119, 0.0112, 6)])
    force = laminate(strain) * np.concatenate([np.ones(600), [0.9, 0.7, 0.5, 0.3, 0.1, 0.02]])
    name = export(tmp_path, np.arange(606) * 0.1, force, strain)
    table, _, _ = run(tmp_path, force_file=name)
    assert table.loc["strength", "value"] == pytest.approx(1500, rel=1e-3)


def test_relaxation_at_a_held_strain_is_no_failure(run: Make, tmp_path: Path) -> None:
    up = np.linspace(0, 0.0035, 200)
    strain = np.concatenate([up, np.full(300, 0.0035)])
    force = laminate(strain) * np.concatenate([np.ones(200), 1 - 0.15 * np.linspace(0, 1, 300)])
    name = export(tmp_path, np.arange(500) * 0.2, force, strain)
    table, _, _ = run(tmp_path, force_file=name)
    assert_not_assessed(table, NEED_FAILURE, "no failure seen")


def test_a_stopped_90_degree_test_does_not_use_the_rule_for_low_ultimate_strains(
    run: Make, tmp_path: Path
) -> None:
    strain = np.linspace(0, 0.0032, 300)
    name = export(tmp_path, np.arange(300) * 0.2, 9000 * strain * (1 - 20 * strain) * 15, strain)
    table, _, _ = run(tmp_path, force_file=name, orientation_deg=90.0)
    assert table.loc["modulus", "range"] == "strain 0.001 to 0.003"
    assert "ultimate strain not known" in table.loc["modulus", "flags"]


def test_a_force_that_falls_while_the_strain_grows_is_failure(run: Make, tmp_path: Path) -> None:
    strain = np.linspace(0, 0.02, 800)
    force = laminate(np.minimum(strain, 0.012)) * np.clip(1 - 90 * (strain - 0.012), 0, 1)
    name = export(tmp_path, np.arange(800) * 0.2, force, strain)
    table, _, _ = run(tmp_path, force_file=name)
    assert table.loc["strength", "value"] == pytest.approx(1500, rel=1e-2)
    assert table.loc["ultimate_strain", "value"] == pytest.approx(0.012, rel=1e-2)


def test_a_drop_of_a_fifth_at_the_end_of_the_record_is_failure(run: Make, tmp_path: Path) -> None:
    # the machine stops recording as soon as it detects the break
    strain = np.append(np.linspace(0, 0.012, 400), 0.01201)
    force = np.append(laminate(strain[:-1]), 0.8 * laminate(0.012))
    name = export(tmp_path, np.arange(401) * 0.2, force, strain)
    table, _, _ = run(tmp_path, force_file=name)
    assert table.loc["strength", "value"] == pytest.approx(1500, rel=1e-3)


def test_the_sheet_can_state_that_it_broke_or_that_it_was_stopped(run: Make) -> None:
    folder = LABCASES / "stopped_before_failure"
    table, _, _ = run(folder, force_file="stopped.csv", failed=True)
    assert table.loc["strength", "value"] == pytest.approx(437.6, rel=1e-3)
    assert "failure as the sheet states it" in table.loc["strength", "flags"]
    table, _, _ = run(folder, force_file="broken1.csv", failed=False)
    assert_not_assessed(table, NEED_FAILURE, "as the sheet states")


def test_a_compression_that_is_stopped_has_no_bending_at_failure(
    make_specimen: Make, make_curve: Make
) -> None:
    from nptcs.reduce import reduce_specimen

    strain = np.linspace(0, 0.004, 201)
    curve = make_curve(-strain, -1e5 * strain, strain_axial_back=-0.98 * strain)
    specimen = make_specimen("C-1", "compression", width_mm=(12.0,))
    table = reduce_specimen(curve, specimen, SETTINGS, "strain_gauge").set_index("property")
    assert_not_assessed(table, [*NEED_FAILURE, "bending_at_failure_percent"], "no failure seen")
    assert np.isfinite(table.loc["bending_percent", "value"])


def test_a_shear_test_that_is_stopped_early_has_no_strength(
    make_specimen: Make, make_curve: Make
) -> None:
    from nptcs.reduce import reduce_specimen

    def shear(largest: float) -> pd.DataFrame:
        gamma = np.linspace(0, largest, 400)
        tau = 60 * np.tanh(3147 * gamma / 60)
        curve = make_curve(0.6 * gamma, 2 * tau, -0.4 * gamma)
        return reduce_specimen(curve, make_specimen("S-1", "shear"), SETTINGS, "dic").set_index(
            "property"
        )

    assert_not_assessed(shear(0.02), ["shear_strength", "ultimate_shear_strain"], "no failure seen")
    # cut at 5 %, the standard's own end: no failure is needed
    assert shear(0.08).loc["shear_strength", "value"] == pytest.approx(60 * np.tanh(2.6225))


def test_no_mean_takes_a_stopped_run_in(run: Make, tmp_path: Path) -> None:
    tables, sheet = [], []
    for number in range(5):
        strain = np.linspace(0, 0.0134 + 1e-4 * number if number < 3 else 0.0035, 300)
        force = laminate(strain)
        if number < 3:
            strain, force = np.append(strain, strain[-1]), np.append(force, 40.0)
        name = export(tmp_path, np.arange(len(strain)) * 0.3, force, strain, f"{number}.csv")
        table, specimen, _ = run(tmp_path, f"T-{number}", force_file=name)
        tables.append(table.reset_index())
        sheet.append(specimen)
    table = group_statistics(pd.concat(tables)[[*tables[0].columns]], sheet, SETTINGS).set_index(
        "property"
    )
    assert table.loc["strength", "n"] == 3
    assert table.loc["strength", "mean"] == pytest.approx(125000 * 0.0135, rel=1e-3)
    assert table.loc["strength", "group_size"] == 5
    assert "T-3: no failure seen" in table.loc["strength", "not_assessed"]
    assert np.isnan(table.loc["strength", "b_basis"])
    assert table.loc["modulus", "n"] == 5


# --- sensors that end before the force -------------------------------------------------------


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
def test_a_gauge_taken_off_for_the_way_to_failure(
    run: Make, folder: str, fields: dict[str, str]
) -> None:
    table, _, _ = run(LABCASES / folder, width_mm=(10.0,), **fields)
    assert table.loc["modulus", "value"] == pytest.approx(100000, rel=1e-3)
    assert table.loc["strength", "value"] == pytest.approx(1998)
    assert "taken for failure" in table.loc["strength", "flags"]
    assert_not_assessed(table, ["ultimate_strain"], "strain recorded up to")


@pytest.mark.parametrize("stuck_at", [0.00252, 0.00299, 0.00305])
def test_a_gauge_that_stands_still_near_the_end_of_the_chord(
    run: Make, tmp_path: Path, stuck_at: float
) -> None:
    strain = np.linspace(0, 0.0045, 700)
    random = np.random.default_rng(2)
    seen = np.minimum(strain, stuck_at) + 1e-7 * random.standard_normal(700)
    name = export(tmp_path, np.arange(700) * 0.2, laminate(strain), seen)
    table, _, _ = run(tmp_path, force_file=name)
    assert table.loc["modulus", "value"] == pytest.approx(125000, rel=2e-3)


def test_no_strain_is_interpolated_across_a_break(run: Make) -> None:
    table, _, _ = run(
        LABCASES / "break_between_frames",
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


# --- reported values pass the limits of the curve --------------------------------------------


def test_a_modulus_in_slack_is_that_of_the_material_or_not_assessed(run: Make) -> None:
    fields = {"width_mm": (10.0,), "gauge_length_mm": 100.0}
    table, _, _ = run(LABCASES / "slack_before_loading", force_file="c5.csv", **fields)
    value = table.loc["modulus", "value"]
    assert np.isnan(value) or value == pytest.approx(20000, rel=1e-3)


@pytest.mark.parametrize("slack", [0.0035, 0.0015, 0.0022])
def test_slack_is_never_reduced_as_stiffness(
    make_specimen: Make, make_curve: Make, slack: float
) -> None:
    from nptcs.reduce import reduce_specimen

    strain = np.linspace(0, 0.014, 600)
    stress = 1.0 + 20000 * np.maximum(strain - slack, 0)
    table = reduce_specimen(make_curve(strain, stress), make_specimen(), SETTINGS, "dic")
    row = table.set_index("property").loc["modulus"]
    assert np.isnan(row["value"])
    assert row["flags"].startswith("not assessed: ")


def test_no_reported_strain_is_negative(run: Make) -> None:
    fields = {"width_mm": (100.0,), "gauge_length_mm": 100.0}
    table, _, _ = run(LABCASES / "travel_runs_back", force_file="c6.csv", **fields)
    value = table.loc["ultimate_strain", "value"]
    assert np.isnan(value) or value > 0


# --- cyclic tests ----------------------------------------------------------------------------


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
    run: Make, loading: str, c10: float, words: str
) -> None:
    fields = {"force_file": "rub_cyc3.csv", "loading": loading}
    table, specimen, done = run(LABCASES / "cyclic_rubber", "R-1", "rubber_tension", **fields)
    value, checks = fit(done, specimen)
    assert value == pytest.approx(c10, rel=2e-3)
    assert f"4 loadings in the record, {words}" in checks
    assert f"4 loadings in the record, {words}" in table.loc["strain_rate", "flags"]


def test_a_cyclic_test_is_in_the_table_of_ranges(run: Make) -> None:
    _, specimen, done = run(
        LABCASES / "cyclic_rubber", "R-1", "rubber_tension", force_file="rub_cyc3.csv"
    )
    curves, material = {"R-1": done.curve}, specimen.material
    table = c10_against_range(material, curves, [specimen], CalibrationSettings())
    row = table[(table["specimen"] == "R-1") & table["in_card"]].iloc[0]
    assert row["c10_mpa"] == pytest.approx(1.0, rel=2e-3)
    assert "4 loadings in the record" in row["remarks"]
    # the first loading ends at 20 %
    beyond = table[(table["specimen"] == "R-1") & (table["strain_high"] == 0.5)].iloc[0]
    assert np.isnan(beyond["c10_mpa"])


def test_two_runs_of_a_piece_in_one_fit_are_said(run: Make) -> None:
    folder, curves, sheet = LABCASES / "cyclic_rubber", {}, []
    for name, file in (("R-1", "rub_cyc3.csv"), ("R-2", "rub_mono.csv")):
        _, specimen, done = run(folder, name, "rubber_tension", force_file=file, piece="R")
        curves[name], sheet = done.curve, [*sheet, specimen]
    card = calibrate_rubber(sheet[0].material, curves, sheet, CalibrationSettings())
    assert any("2 runs of R are in the fit" in check for check in card.checks)


def test_a_loading_that_the_record_lacks_is_an_error(run: Make) -> None:
    fields = {"force_file": "rub_cyc3.csv", "loading": "5"}
    with pytest.raises(InputError, match=r"R-1.*the record has 4 loadings"):
        run(LABCASES / "cyclic_rubber", "R-1", "rubber_tension", **fields)
    with pytest.raises(InputError, match="the record has 1 loading "):
        run(
            LABCASES / "cyclic_rubber",
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
    run: Make, tmp_path: Path, loading: str, c10: float
) -> None:
    strain, stress = cycles_with_set([1.0, 0.85, 0.75, 0.7], 0.5, 0.01)
    name = export(tmp_path, np.arange(len(strain)) * 0.1, 12 * stress, strain)
    table, specimen, done = run(tmp_path, "R-1", "rubber_tension", force_file=name, loading=loading)
    value, checks = fit(done, specimen)
    assert value == pytest.approx(c10, rel=0.02)
    assert "4 loadings" in checks
    assert ("the set of" in checks) == (loading != "first")


def test_modulus_cycles_of_a_laminate_and_the_pull_that_breaks_it(
    run: Make, tmp_path: Path
) -> None:
    course = [0, 0.004, 0.0005, 0.004, 0.0005, 0.0122]
    strain = np.concatenate(
        [np.linspace(a, b, 150)[1:] for a, b in zip(course, course[1:], strict=False)]
    )
    # stiffer by 3 % in the first loading than afterwards
    force = laminate(strain) * np.where(np.arange(len(strain)) < 149, 1.03, 1.0)
    strain, force = np.append(strain, strain[-1]), np.append(force, 10.0)
    name = export(tmp_path, np.arange(len(strain)) * 0.2, force, strain)
    table, _, _ = run(tmp_path, force_file=name)
    assert table.loc["modulus", "value"] == pytest.approx(1.03 * 125000, rel=2e-3)
    assert table.loc["strength", "value"] == pytest.approx(125000 * 0.0122, rel=1e-3)
    assert "3 loadings in the record, the first taken" in table.loc["modulus", "flags"]
    table, _, _ = run(tmp_path, force_file=name, loading="last")
    assert table.loc["modulus", "value"] == pytest.approx(125000, rel=2e-3)


def test_the_energy_is_that_of_the_loading_that_broke(
    make_specimen: Make, make_curve: Make
) -> None:
    from nptcs.reduce import reduce_specimen

    first, second = np.linspace(0, 0.5, 100), np.linspace(0, 2.0, 300)
    strain = np.concatenate([first, first[::-1], second])
    curve = make_curve(strain, neo_hooke(strain, 1.0))

    def energy(loading: str) -> Any:
        specimen = make_specimen("R-1", "rubber_tension", loading=loading)
        table = reduce_specimen(curve, specimen, SETTINGS, failure_seen=True)
        return table.set_index("property").loc["strain_energy_density"]

    exact = 1.0 * (3.0**2 + 2 / 3.0 - 3)
    assert energy("last")["value"] == pytest.approx(exact, rel=1e-3)
    assert energy("envelope")["value"] == pytest.approx(exact, rel=2e-3)
    assert "not the one that broke" in energy("first")["flags"]


@pytest.mark.parametrize("noise", [0.0, 2e-5])
def test_serrations_noise_and_slips_are_no_loadings(noise: float) -> None:
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


# --- runs of one piece -----------------------------------------------------------------------


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
    run: Make, tmp_path: Path
) -> None:
    tables, sheet = [], []
    for number in range(3):
        strain = np.linspace(0, 0.0035, 200)
        export(
            tmp_path, np.arange(200) * 0.2, laminate(strain, 50000), strain, f"{number}_modulus.csv"
        )
        # the rupture run has a travel-like strain, half as stiff, and breaks
        strain = np.append(np.linspace(0, 0.026, 300), 0.026)
        force = np.append(laminate(strain[:-1], 25000), 60.0)
        export(tmp_path, np.arange(301) * 0.2, force, strain, f"{number}_rupture.csv")
        more, rows = runs_of_a_piece(run, tmp_path, number)
        tables += more
        sheet += rows
    table = group_statistics(pd.concat(tables), sheet, SETTINGS).set_index("property")
    assert table.loc["modulus", ["n", "group_size"]].tolist() == [3, 3]
    assert table.loc["modulus", "mean"] == pytest.approx(50000, rel=1e-3)
    assert table.loc["strength", "n"] == 3
    assert table.loc["strength", "mean"] == pytest.approx(650, rel=1e-3)
    assert "P-0-rupture: the sheet takes other properties" in table.loc["modulus", "left_out"]


def test_the_modulus_run_and_the_rupture_of_one_piece(run: Make) -> None:
    folder = LABCASES / "modulus_runs_and_rupture"
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
    table = group_statistics(pd.concat(tables), sheet, SETTINGS).set_index("property")
    assert table.loc["modulus", ["n", "mean"]].tolist() == pytest.approx([1, 50000], rel=1e-3)
    assert table.loc["strength", ["n", "mean"]].tolist() == pytest.approx([1, 650], rel=1e-6)


def test_runs_that_give_the_same_property_count_once(make_specimen: Make) -> None:
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
    row = group_statistics(table, sheet, SETTINGS).iloc[0]
    assert (row["n"], row["mean"]) == (2, 15.5)


def test_a_row_that_names_a_property_of_another_test_is_refused(make_specimen: Make) -> None:
    with pytest.raises(ValueError, match="properties names 'shear_modulus', but a tension test"):
        make_specimen(properties=("shear_modulus",))
    assert make_specimen("R", "rubber_tension", properties=("stress_at_150_percent",))
