import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from nptcs.fe.spoke.stored import read_arrays, write_arrays

ARRAYS = {
    "places": np.arange(6).reshape(3, 2),
    "field": np.linspace(0.0, 1.0, 12, dtype=np.float32),
}
KIND = "numbers 1 key"


def test_arrays_are_read_back_unchanged(tmp_path):
    path = tmp_path / "folder" / "a.npz"
    write_arrays(path, KIND, ARRAYS)
    back = read_arrays(path, KIND)
    assert {name: array.tolist() for name, array in back.items()} == {
        name: array.tolist() for name, array in ARRAYS.items()
    }


def test_another_kind_version_or_key_is_a_miss(tmp_path):
    path = tmp_path / "a.npz"
    write_arrays(path, KIND, ARRAYS)
    assert read_arrays(path, "numbers 2 key") is None
    assert read_arrays(tmp_path / "absent.npz", KIND) is None


def test_pickled_objects_are_not_read(tmp_path):
    path = tmp_path / "a.npz"
    np.savez(path, places=np.array([{"a": 1}], dtype=object), allow_pickle=True)
    assert read_arrays(path, KIND) is None


def test_a_number_that_is_not_finite_is_a_miss(tmp_path):
    path = tmp_path / "a.npz"
    write_arrays(path, KIND, {"field": np.array([1.0, np.inf])})
    assert read_arrays(path, KIND) is None


@given(st.data())
@settings(
    max_examples=150, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture]
)
def test_a_damaged_file_is_a_miss_or_unchanged(tmp_path, data):
    path = tmp_path / "a.npz"
    write_arrays(path, KIND, ARRAYS)
    content = bytearray(path.read_bytes())
    if data.draw(st.booleans(), label="cut"):
        content = content[: data.draw(st.integers(0, len(content) - 1), label="length")]
    else:
        place = data.draw(st.integers(0, len(content) - 1), label="place")
        content[place] ^= data.draw(st.integers(1, 255), label="bits")
    path.write_bytes(content)
    back = read_arrays(path, KIND)
    if back is not None:
        for name, array in ARRAYS.items():
            assert back[name].tolist() == array.tolist()


@pytest.mark.parametrize("content", [b"", b"PK", b"\x93NUMPY", b"\x80\x04}q\x00."])
def test_other_content_is_a_miss(tmp_path, content):
    path = tmp_path / "a.npz"
    path.write_bytes(content)
    assert read_arrays(path, KIND) is None
