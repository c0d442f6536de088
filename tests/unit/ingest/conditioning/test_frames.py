"""Camera frames without a clock: by trigger, by number, and strain fields of one file each."""

from __future__ import annotations

import numpy as np
import pytest

from nptcs.config.materials.ingest import FileLimits
from nptcs.errors import InputError
from nptcs.ingest.strain_fields import read_strain_fields

FRAMES = np.arange(1, 41)
STRAIN = 3e-4 * (FRAMES - 1)
ROWS = 420
STEP = 10
LOAD = np.minimum(np.arange(ROWS) / STEP, 39.5) * 30.0
LOAD[396:] = 2.0


def machine(lab, folder, **columns):
    lab.write(folder / "m.csv", {"Load [N]": LOAD, **columns})


def camera(lab, folder, **columns):
    lab.write(folder / "c.csv", {"exx [1]": STRAIN, "eyy [1]": -0.3 * STRAIN, **columns})


def check(lab, done):
    """3 N per 1e-4 of strain over 10 mm²: 10,000 MPa; the peak lies behind the last frame."""
    assert lab.modulus(done) == pytest.approx(10_000, rel=1e-6)
    assert done.curve["force_n"].max() == pytest.approx(LOAD.max())
    assert lab.last_strain(done) == pytest.approx(LOAD.max() / 1e5, rel=1e-6)
    assert done.record.failure_seen


def test_frames_by_the_edges_of_a_trigger(lab, tmp_path):
    trigger = np.where(np.arange(ROWS) % STEP < 3, 5.0, 0.1)
    trigger[400:] = 0.1
    machine(lab, tmp_path, **{"Trigger [V]": trigger})
    camera(lab, tmp_path)
    check(lab, lab.ingest(tmp_path, "m.csv", strain_file="c.csv"))


def test_a_trigger_with_another_number_of_edges_is_refused(lab, tmp_path):
    machine(lab, tmp_path, **{"Trigger [V]": np.where(np.arange(ROWS) % 7 < 3, 5.0, 0.1)})
    camera(lab, tmp_path)
    with pytest.raises(InputError, match="cannot be paired"):
        lab.ingest(tmp_path, "m.csv", strain_file="c.csv")


def test_frames_by_their_number(lab, tmp_path):
    machine(lab, tmp_path, **{"Image": np.minimum(np.arange(ROWS) // STEP + 1, 41)})
    camera(lab, tmp_path, Count=FRAMES)
    check(lab, lab.ingest(tmp_path, "m.csv", strain_file="c.csv"))


def fields(folder, names, header="x,y,exx,eyy,zncc", edge=0.05):
    """Points of one frame per file; outside 10..20 the strain is that of an edge."""
    folder.mkdir()
    for number, strain in zip(FRAMES, STRAIN, strict=True):
        rows = [header]
        for x in range(0, 31, 2):
            value = strain if 10 <= x <= 20 else edge
            rows.append(f"{x},5,{value:.9g},{-0.3 * value:.9g},0.99")
        (folder / names.format(number)).write_text("\n".join(rows))


@pytest.mark.parametrize("names", ["frame_{}.csv", "T1-{:04d}_0.csv"])
def test_strain_fields_are_a_mean_over_the_stated_window(lab, tmp_path, profiles, names):
    fields(tmp_path / "dic", names)
    machine(lab, tmp_path, **{"Image": np.minimum(np.arange(ROWS) // STEP + 1, 41)})
    own = profiles["opencorr"].model_copy(update={"name": "own", "window": {"x": (10.0, 20.0)}})
    there = type(lab)({**profiles, "own": own})
    done = there.ingest(tmp_path, "m.csv", strain_file="dic", strain_format="own")
    check(lab, done)
    assert "6 to 6 points" in done.record.files[1].notes[0]


def test_a_window_without_points_is_refused(lab, tmp_path, profiles):
    fields(tmp_path / "dic", "f{}.csv")
    own = profiles["opencorr"].model_copy(update={"window": {"x": (100.0, 120.0)}})
    with pytest.raises(InputError, match="no point lies in the window"):
        read_strain_fields(tmp_path / "dic", profiles, own, FileLimits())
