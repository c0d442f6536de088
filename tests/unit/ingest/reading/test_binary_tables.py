"""LabVIEW TDMS and MATLAB files, written by their own libraries and read back."""

from __future__ import annotations

from io import BytesIO

import h5py
import numpy as np
import pytest
from nptdms import ChannelObject, TdmsWriter
from scipy.io import savemat

from nptcs.config.materials.ingest import FileLimits
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
        (b"MATLAB 7.3 MAT-file, Platform", "cannot be read"),
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


def write_73(path, variables):
    """Write a file of MATLAB's version 7.3: HDF5 behind a block of 512 bytes, columns first."""

    def put(group, name, value):
        if isinstance(value, dict):
            for field, one in value.items():
                put(group.create_group(name) if name not in group else group[name], field, one)
        elif isinstance(value, list):
            held = group.file.require_group("#refs#")
            places = [
                held.create_dataset(f"{name}{i}", data=np.asarray(one).T).ref
                for i, one in enumerate(value)
            ]
            group.create_dataset(name, data=np.array([places], dtype=h5py.ref_dtype))
        else:
            group.create_dataset(name, data=np.atleast_2d(value))

    with h5py.File(path, "w", userblock_size=512) as file:
        for name, value in variables.items():
            put(file, name, value)
    with path.open("r+b") as file:
        file.write(b"MATLAB 7.3 MAT-file, Platform: GLNXA64".ljust(512))


@pytest.mark.parametrize("nested", [False, True])
def test_a_mat_file_of_version_73_is_read_as_one_of_version_7(lab, tmp_path, nested):
    columns = {"time_s": TIME, "force_kN": FORCE / 1e3, "strain": STRAIN}
    write_73(tmp_path / "a.mat", {"run": columns} if nested else columns)
    done = lab.ingest(tmp_path, "a.mat")
    assert lab.modulus(done) == pytest.approx(120_000, rel=1e-6)


def ncorr_fields():
    """Strain fields of ten frames, zero outside the region of interest."""
    fields = {"plot_exx_ref_formatted": [], "plot_eyy_ref_formatted": []}
    for strain in STRAIN[:10]:
        inside = np.zeros((6, 8))
        inside[1:5, 2:7] = 1 + 0.1 * np.linspace(-1, 1, 5)
        fields["plot_exx_ref_formatted"].append(-0.3 * strain * inside)
        fields["plot_eyy_ref_formatted"].append(strain * inside)
    return fields


@pytest.mark.parametrize("version", ["7", "7.3"])
def test_what_ncorr_saves_is_the_mean_over_its_region(lab, tmp_path, version):
    fields = ncorr_fields()
    if version == "7":
        frames = np.array(
            list(zip(*fields.values(), strict=True)), dtype=[(name, object) for name in fields]
        )
        savemat(tmp_path / "ncorr.mat", {"data_dic_save": {"strains": frames}})
    else:
        write_73(tmp_path / "ncorr.mat", {"data_dic_save": {"strains": fields}})
    machine = {"Frame": np.arange(1, 11), "Load [N]": FORCE[:10]}
    lab.write(tmp_path / "m.csv", machine)
    done = lab.ingest(tmp_path, "m.csv", strain_file="ncorr.mat")
    assert lab.modulus(done, 0.0005, 0.0018) == pytest.approx(120_000, rel=1e-6)
    assert done.record.strain_source == "dic"
    assert done.curve["strain_transverse"].dropna().iloc[-1] == pytest.approx(-0.3 * STRAIN[9])


def test_a_matrix_takes_the_names_stored_next_to_it(read):
    buffer = BytesIO()
    time = np.arange(20.0)
    names = np.array(["Time [s]", "Force [N]", "Strain [%]"], dtype=object)
    savemat(buffer, {"data": np.c_[time, 100 * time, 0.05 * time], "names": names})
    raw = read(buffer.getvalue(), "a.mat")
    assert raw.values["strain"] == pytest.approx(5e-4 * time)
    assert raw.values["force"] == pytest.approx(100 * time)
