"""LabVIEW TDMS and MATLAB files, written by their own libraries and read back."""

from __future__ import annotations

import numpy as np
import pytest
from nptdms import ChannelObject, TdmsWriter
from scipy.io import savemat

from nptcs.config.ingest import FileLimits
from nptcs.errors import InputError
from nptcs.ingest.reading.raw_file import read_raw

TIME = np.arange(0, 30.0, 0.5)
STRAIN = 0.0002 * (TIME / 0.5)
FORCE = 1.2e6 * STRAIN


@pytest.mark.parametrize("waveform", [False, True])
def test_a_tdms_group_is_a_table_with_its_units(lab, tmp_path, waveform):
    shared = {"wf_increment": 0.5} if waveform else {}
    channels = [
        ChannelObject("Data", "Load", FORCE / 1e3, {"unit_string": "kN", **shared}),
        ChannelObject("Data", "Strain", 1e6 * STRAIN, {"unit_string": "µm/m", **shared}),
        ChannelObject("Events", "Marks", np.array([1.0, 2.0]), {}),
    ]
    if not waveform:
        channels.append(ChannelObject("Data", "Time", TIME, {"unit_string": "s"}))
    with TdmsWriter(str(tmp_path / "a.tdms")) as writer:
        writer.write_segment(channels)
    done = lab.ingest(tmp_path, "a.tdms")
    assert lab.modulus(done) == pytest.approx(120_000, rel=1e-6)
    assert np.diff(done.curve["time_s"]) == pytest.approx(0.5)


@pytest.mark.parametrize("nested", [False, True])
def test_vectors_of_a_mat_file_are_a_table(lab, tmp_path, nested):
    columns = {"time_s": TIME, "force_kN": FORCE / 1e3, "strain": STRAIN, "operator": "X"}
    savemat(tmp_path / "a.mat", {"run": columns} if nested else columns)
    done = lab.ingest(tmp_path, "a.mat")
    assert lab.modulus(done) == pytest.approx(120_000, rel=1e-6)


def test_a_mat_file_without_units_says_which(lab, tmp_path):
    savemat(tmp_path / "a.mat", {"time": TIME, "force": FORCE, "strain": STRAIN})
    with pytest.raises(InputError, match="no unit for force"):
        lab.ingest(tmp_path, "a.mat")


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (b"MATLAB 7.3 MAT-file, Platform", "version 7.3"),
        (b"MATLAB 5.0 MAT-file" + b"\xff" * 300, "cannot be read"),
        (b"TDSm" + b"\xff" * 300, "cannot be read"),
    ],
)
def test_damaged_files_are_refused(lab, tmp_path, content, message):
    (tmp_path / "a.bin").write_bytes(content)
    with pytest.raises(InputError, match=message):
        lab.ingest(tmp_path, "a.bin")


def test_a_mat_file_that_unpacks_too_large_is_refused(profiles, tmp_path):
    savemat(tmp_path / "a.mat", {"zeros": np.zeros((3000, 1000))}, do_compression=True)
    assert (tmp_path / "a.mat").stat().st_size < 1e6
    with pytest.raises(InputError, match="unpacks to"):
        read_raw(tmp_path / "a.mat", profiles, limits=FileLimits(unpacked_mb=10))
