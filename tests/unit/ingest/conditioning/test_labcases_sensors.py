"""Breaks, signs, slack, sensors that leave: the labcases, and further inputs of each kind."""

from __future__ import annotations

import numpy as np
import pytest

from nptcs.errors import InputError

E_MPA = 100_000.0
TIME = np.arange(0, 100.0, 0.1)
FORCE = 200.0 * TIME
STRAIN = FORCE / 10 / E_MPA


def test_the_strain_at_a_break_between_two_frames_is_extended_from_before_it(lab):
    done = lab.ingest(
        lab.cases / "break_between_frames", "c1_machine.csv", strain_file="c1_camera.csv"
    )
    assert 0.0120 <= lab.last_strain(done) <= 0.01204 + 1e-9
    assert done.curve["stress_mpa"].max() == pytest.approx(120.4)
    assert done.record.failure_seen
    assert lab.flagged(done, "extended from the last 4 frames")


@pytest.mark.parametrize("offset", [0.0, 0.37])
def test_a_camera_that_goes_on_after_a_machine_that_stops_at_the_break(lab, tmp_path, offset):
    """The machine's record ends at the peak, so that only the camera shows the break."""
    time = np.arange(0, 60.21, 0.01)
    lab.write(tmp_path / "m.csv", {"Time [s]": time, "Load [N]": 20 * time})
    frames = np.arange(0, 70.0)
    strain = np.where(frames <= 60.2, 2e-4 * frames, 5e-4)
    load = np.where(frames <= 60.2, 20 * frames, 0)
    lab.write(
        tmp_path / "c.csv",
        {"Time_0": frames - offset, "exx [1]": strain, "eyy [1]": -0.3 * strain, "Force": load},
        ";",
    )
    done = lab.ingest(tmp_path, "m.csv", strain_file="c.csv")
    assert lab.last_strain(done) == pytest.approx(0.01204, abs=1e-6)
    assert done.curve["strain_axial"].max() == pytest.approx(0.01204, abs=1e-6)


def test_a_break_within_a_slow_machine_record_and_a_fast_camera(lab, tmp_path):
    time = np.arange(0, 66.0)
    force = np.where(time <= 60, 20 * time, 0.0)
    lab.write(tmp_path / "m.csv", {"Time [s]": time, "Load [N]": force})
    frames = np.arange(0, 65.0, 0.13)
    strain = np.where(frames <= 60.04, 2e-4 * frames, 3e-4)
    lab.write(tmp_path / "c.csv", {"time [s]": frames, "exx [1]": strain, "eyy [1]": -0.3 * strain})
    done = lab.ingest(tmp_path, "m.csv", strain_file="c.csv")
    assert lab.last_strain(done) == pytest.approx(0.0120, rel=1e-3)
    rows = done.curve.dropna(subset="strain_axial")
    assert rows["stress_mpa"].to_numpy() == pytest.approx(rows["strain_axial"] * 10_000, abs=0.01)


def test_a_camera_force_without_a_clock_is_cut_at_its_break(lab, tmp_path):
    force = np.concatenate([np.linspace(0, 1000, 50), [3.0, 2.0, 1.0]])
    strain = np.concatenate([np.linspace(0, 0.01, 50), [0.02, 0.0, 0.0]])

    lab.write(
        tmp_path / "m.csv",
        {"Load [N]": np.linspace(0, 1010, 400), "Displacement [mm]": np.linspace(0, 1, 400)},
    )
    lab.write(tmp_path / "c.csv", {"Force [N]": force, "exx [1]": strain, "eyy [1]": -0.3 * strain})
    done = lab.ingest(tmp_path, "m.csv", strain_file="c.csv")
    assert done.curve["force_n"].iloc[-1] == pytest.approx(1010)
    assert lab.last_strain(done) == pytest.approx(0.0101, rel=1e-3)


def test_an_extensometer_taken_off_leaves_modulus_and_strength(lab):
    done = lab.ingest(lab.cases / "extensometer_taken_off", "c2.csv")
    assert lab.modulus(done) == pytest.approx(E_MPA, rel=1e-6)
    assert done.curve["stress_mpa"].max() == pytest.approx(1998)
    assert np.isnan(lab.last_strain(done))
    assert lab.flagged(done, "extensometer removed or slipped")


@pytest.mark.parametrize("rest", [-0.03, 0.0, 0.045, -0.4])
@pytest.mark.parametrize("share", [0.3, 0.7])
def test_an_extensometer_that_rests_anywhere_is_found_before_sign_and_axis(
    lab, tmp_path, rest, share
):
    strain = np.where(share * TIME[-1] > TIME, STRAIN, rest)
    extension = 25.0 * strain
    lab.write(tmp_path / "a.csv", {"Time [s]": TIME, "Load [N]": FORCE, "Strain [mm/mm]": strain})
    lab.write(
        tmp_path / "b.csv", {"Time [s]": TIME, "Load [N]": FORCE, "Extensometer [mm]": extension}
    )
    for name in ("a.csv", "b.csv"):
        done = lab.ingest(tmp_path, name, gauge_length_mm=25.0)
        assert lab.modulus(done) == pytest.approx(E_MPA, rel=1e-5)
        assert done.curve["stress_mpa"].max() == pytest.approx(FORCE.max() / 10)
        assert np.isnan(lab.last_strain(done))


def test_an_extensometer_that_leaves_after_readings_without_strain(lab, tmp_path):
    strain = np.where(TIME < 60, STRAIN, -0.03)
    strain[598:600] = np.nan
    lab.write(tmp_path / "a.csv", {"Time [s]": TIME, "Load [N]": FORCE, "Strain [%]": 100 * strain})
    done = lab.ingest(tmp_path, "a.csv")
    assert np.isnan(lab.last_strain(done))
    assert done.curve["strain_axial"].max() == pytest.approx(STRAIN[597], rel=1e-3)


def test_an_extensometer_at_the_end_of_its_range_stands_still(lab, tmp_path):
    strain = np.minimum(STRAIN, 0.01)
    lab.write(tmp_path / "a.csv", {"Time [s]": TIME, "Load [N]": FORCE, "Strain [%]": 100 * strain})
    done = lab.ingest(tmp_path, "a.csv")
    assert np.isnan(lab.last_strain(done))
    assert done.curve["strain_axial"].max() == pytest.approx(0.01, rel=0.06)


def test_an_extensometer_that_slides_back_slowly_is_cut_where_it_turns(lab, tmp_path):
    back = np.where(TIME < 60, STRAIN, STRAIN[600] - 0.5 * (STRAIN - STRAIN[600]))
    lab.write(tmp_path / "a.csv", {"Time [s]": TIME, "Load [N]": FORCE, "Strain [%]": 100 * back})
    done = lab.ingest(tmp_path, "a.csv")
    assert done.curve["strain_axial"].max() == pytest.approx(STRAIN[600], rel=1e-3)
    assert np.isnan(lab.last_strain(done))
    assert lab.flagged(done, "moves back")


def test_a_strain_record_that_ends_early_keeps_modulus_and_strength(lab):
    done = lab.ingest(
        lab.cases / "strain_record_ends_early", "c10_force.csv", strain_file="c10_strain.csv"
    )
    assert lab.modulus(done) == pytest.approx(E_MPA, rel=1e-6)
    assert done.curve["stress_mpa"].max() == pytest.approx(1998)
    assert np.isnan(lab.last_strain(done))
    assert lab.flagged(done, "the strain record ends at 7980 N of 19980 N")


@pytest.mark.parametrize(("unit", "scale"), [("N", 1.0), ("kN", 1e-3), ("", 1e-3)])
@pytest.mark.parametrize("offset", [0.0, 12.5])
def test_a_short_strain_record_with_another_clock_and_unit(lab, tmp_path, unit, scale, offset):
    lab.write(tmp_path / "m.csv", {"Time [s]": TIME, "Load [N]": FORCE})
    frames = np.arange(0, 45.0, 0.5)
    strain = 200 * frames / 10 / E_MPA
    name = f"Force [{unit}]" if unit else "Force"
    lab.write(
        tmp_path / "c.csv",
        {
            "time [s]": frames + offset,
            "exx [1]": strain,
            "eyy [1]": -0.3 * strain,
            name: scale * 200 * frames,
        },
    )
    done = lab.ingest(tmp_path, "m.csv", strain_file="c.csv")
    assert lab.modulus(done) == pytest.approx(E_MPA, rel=1e-4)
    assert done.curve["stress_mpa"].max() == pytest.approx(FORCE.max() / 10)
    assert np.isnan(lab.last_strain(done))


def test_a_short_strain_record_of_another_specimen_is_refused(lab, tmp_path):
    """The same kind of record, but the force grows at another rate: not the same specimen."""
    lab.write(tmp_path / "m.csv", {"Time [s]": TIME, "Load [N]": FORCE})
    frames = np.arange(0, 45.0, 0.5)
    lab.write(
        tmp_path / "c.csv",
        {"time [s]": frames, "Strain [1]": 1e-4 * frames, "Force [N]": 130 * frames},
    )
    with pytest.raises(InputError, match="largest force is"):
        lab.ingest(tmp_path, "m.csv", strain_file="c.csv")


def test_travel_that_slips_back_is_cut(lab):
    done = lab.ingest(
        lab.cases / "travel_runs_back", "c6.csv", gauge_length_mm=100, thickness_mm=(10.0,)
    )
    strain = done.curve["strain_axial"]
    assert strain.min() >= 0
    assert strain.max() == pytest.approx(0.06, rel=1e-3)
    assert np.isnan(lab.last_strain(done))
    assert lab.flagged(done, "transducer of travel slipped")


@pytest.mark.parametrize("slip_mm", [0.5, 3.0])
def test_travel_that_drifts_back_while_the_force_grows(lab, tmp_path, slip_mm):
    travel = np.where(TIME < 70, 0.05 * TIME, 3.5 - slip_mm / 30 * (TIME - 70))
    lab.write(tmp_path / "a.csv", {"Time": TIME, "Displacement [mm]": travel, "Force [N]": FORCE})
    done = lab.ingest(tmp_path, "a.csv", gauge_length_mm=100)
    assert done.curve["strain_axial"].max() == pytest.approx(0.035, rel=0.01)
    assert np.isnan(lab.last_strain(done))


def test_slack_is_taken_off_before_the_modulus(lab):
    done = lab.ingest(lab.cases / "slack_before_loading", "c5.csv", gauge_length_mm=100)
    assert lab.modulus(done) == pytest.approx(20_000, rel=1e-6)
    assert lab.flagged(done, "slack or long toe: strain 0.0049")


@pytest.mark.parametrize("rubber", [False, True])
@pytest.mark.parametrize("noise", [0.0, 0.3])
def test_slack_with_noise_in_laminate_and_rubber(lab, tmp_path, rubber, noise):
    """A rope tightens first; the true slope of what follows is known."""
    random = np.random.default_rng(3)
    travel = np.arange(0, 60.0 if rubber else 6.0, 0.02)
    free = 12.0 if rubber else 0.9
    slope = 2.0 if rubber else 250.0
    force = slope * np.clip(travel - free, 0, None) + noise * random.standard_normal(len(travel))
    lab.write(
        tmp_path / "a.csv",
        {"Time [s]": travel, "Displacement [mm]": travel, "Load [N]": force},
    )
    fields = {"gauge_length_mm": 50.0}
    if rubber:
        fields |= {"test": "rubber_tension", "orientation_deg": None}
    done = lab.ingest(tmp_path, "a.csv", **fields)
    low, high = (0.05, 0.3) if rubber else (0.005, 0.05)
    assert lab.modulus(done, low, high) == pytest.approx(slope * 50 / 10, rel=0.01)
    assert done.curve["strain_axial"].iloc[0] < (0.02 if rubber else 0.002)
    assert lab.flagged(done, "slack")


def test_a_toe_longer_than_the_window_is_passed(lab, tmp_path):
    travel = np.arange(0, 5.0, 0.01)
    force = 200 * (travel - 1.5 * (1 - np.exp(-travel / 1.5)))
    lab.write(tmp_path / "a.csv", {"Displacement [mm]": travel, "Load [N]": force})
    done = lab.ingest(tmp_path, "a.csv", gauge_length_mm=100)
    strain, stress = done.curve["strain_axial"], done.curve["stress_mpa"]
    assert lab.modulus(done, strain.iloc[0], strain.iloc[-1]) == pytest.approx(2000, rel=0.12)
    assert stress.iloc[0] > 0
    assert lab.flagged(done, "slack or long toe")


def test_one_curve_from_compression_to_tension_is_split(lab):
    done = lab.ingest(
        lab.cases / "two_signs",
        "rub_both.csv",
        test="rubber_tension",
        orientation_deg=None,
        width_mm=(6.0,),
        thickness_mm=(2.0,),
    )
    assert done.curve["stress_mpa"].max() == pytest.approx(2.419, abs=1e-3)
    assert done.curve["stress_mpa"].min() >= 0
    assert lab.last_strain(done) == pytest.approx(0.6, abs=2e-3)
    assert lab.flagged(done, "recorded in compression, too (to -52.267 N, strain -0.4)")


def test_a_platen_test_is_not_reduced_as_tension(lab):
    with pytest.raises(InputError, match="records as compression"):
        lab.ingest(lab.cases / "two_signs", "platen.csv", gauge_length_mm=50, width_mm=(25.0,))


@pytest.mark.parametrize("test", ["tension", "compression"])
def test_a_cycle_through_zero_gives_the_part_of_the_sheets_test(lab, tmp_path, test):
    """Tension to 1 % and compression to 0.8 %, twice; each part has its own strength."""
    phase = np.linspace(0, 4 * np.pi, 800)
    strain = np.where(np.sin(phase) > 0, 0.01, 0.008) * np.sin(phase)
    lab.write(
        tmp_path / "a.csv",
        {"Time [s]": phase, "Load [N]": 1e6 * strain, "Strain [%]": 100 * strain},
    )
    done = lab.ingest(tmp_path, "a.csv", test=test)
    stress = done.curve["stress_mpa"]
    if test == "tension":
        assert (stress.max(), stress.min()) == (
            pytest.approx(1000, rel=1e-3),
            pytest.approx(0, abs=20),
        )
        assert lab.flagged(done, "recorded in compression, too")
    else:
        assert stress.min() == pytest.approx(-800, rel=1e-3)
        assert lab.flagged(done, "recorded in tension, too")


@pytest.mark.parametrize("sign", [1, -1])
def test_a_reversed_load_cell_is_turned_only_if_a_gauge_lengthens(lab, tmp_path, sign):
    columns = {"Time [s]": TIME, "Load [N]": -FORCE, "Strain [%]": sign * 100 * STRAIN}
    lab.write(tmp_path / "a.csv", columns)
    if sign > 0:
        done = lab.ingest(tmp_path, "a.csv")
        assert done.curve["stress_mpa"].max() == pytest.approx(FORCE.max() / 10)
        assert lab.flagged(done, "its sign was turned")
    else:
        with pytest.raises(InputError, match="records as compression"):
            lab.ingest(tmp_path, "a.csv")


@pytest.mark.parametrize(
    ("head", "own"),
    [
        (("Test type: Compression of cubes",), "compression"),
        (("Prüfverfahren: Druckversuch",), "compression"),
        (("Method,Three-point bending ISO 14125",), "flexure"),
        (("Prueba: Compresión",), "compression"),
        (("Deney tipi: Basma deneyi",), "compression"),
        (("Proef: drukproef",), "compression"),
        (("시험 방법: 굽힘",), "flexure"),
        (("Provning: böjprov",), "flexure"),
    ],
)
def test_a_file_that_calls_itself_another_test_is_refused(lab, tmp_path, head, own):
    columns = {"Time [s]": TIME, "Load [N]": FORCE, "Displacement [mm]": TIME / 10}
    lab.write(tmp_path / "a.csv", columns, head=head)
    with pytest.raises(InputError, match=f"calls itself {own}"):
        lab.ingest(tmp_path, "a.csv", gauge_length_mm=50)


@pytest.mark.parametrize(
    ("name", "own"), [("Compressive strain [%]", "compression"), ("Flexure strain [%]", "flexure")]
)
def test_a_column_that_names_another_loading_stops_the_specimen(lab, tmp_path, name, own):
    """Even a column that is not used."""
    columns = {"Time [s]": TIME, "Load [N]": FORCE, "Displacement [mm]": TIME / 10, name: STRAIN}
    lab.write(tmp_path / "a.csv", columns)
    with pytest.raises(InputError, match=f"calls itself {own}"):
        lab.ingest(tmp_path, "a.csv", gauge_length_mm=50)


@pytest.mark.parametrize("head", ["Tensile test, compression load cell", "Compression limit,5"])
def test_a_word_that_does_not_name_the_test_does_not_stop_it(lab, tmp_path, head):
    columns = {"Time [s]": TIME, "Load [N]": FORCE, "Strain [%]": 100 * STRAIN}
    lab.write(tmp_path / "a.csv", columns, head=(head,))
    assert lab.modulus(lab.ingest(tmp_path, "a.csv")) == pytest.approx(E_MPA, rel=1e-5)


@pytest.mark.parametrize("axial", ["exx", "eyy"])
def test_the_axis_of_a_45_degree_laminate_is_told_by_its_sign(lab, tmp_path, axial):
    """Poisson's ratio 0.93: the strains are as large, but only one follows the load."""
    other = {"exx": "eyy", "eyy": "exx"}[axial]
    gamma = 3e-5 * TIME
    columns = {"Time [s]": TIME, "Load [N]": 150_000 * gamma}
    columns |= {f"{axial} [1]": 0.518 * gamma, f"{other} [1]": -0.482 * gamma}
    lab.write(tmp_path / "a.csv", columns)
    done = lab.ingest(tmp_path, "a.csv", test="shear", orientation_deg=45)
    assert done.curve["strain_axial"].iloc[-1] == pytest.approx(0.518 * gamma[-1], rel=1e-3)
    columns["Load [N]"] = -columns["Load [N]"]
    lab.write(tmp_path / "b.csv", columns)
    with pytest.raises(InputError, match="cannot be told from the data"):
        lab.ingest(tmp_path, "b.csv", test="shear", orientation_deg=45)
