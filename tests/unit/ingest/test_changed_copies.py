"""Copies of a test that were cut or thinned are found; other specimens are not."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from nptcs.ingest.reading.profiles import FormatProfile
from nptcs.ingest.reading.raw_file import RawFile
from nptcs.ingest.sketch import ChangedCopies, data_sketch

STRAIN = np.linspace(0, 0.012, 600)


def sketch_of(load, strain, path):
    values = {"force": np.asarray(load), "strain": np.asarray(strain)}
    profile = FormatProfile(name="x", title="x")
    return data_sketch([RawFile(path, profile, True, "", values, {}, {})])


def record_of(seed, modulus=1.2e6):
    """A specimen's record: its own scatter of stiffness, and noise."""
    random = np.random.default_rng(seed)
    load = modulus * (1 + 0.01 * random.standard_normal()) * STRAIN
    return load + 2.0 * random.standard_normal(len(load))


CHANGES = {
    "cut at the end": lambda load: (load[:-40], STRAIN[:-40]),
    "cut at the start": lambda load: (load[100:], STRAIN[100:]),
    "thinned": lambda load: (load[::2], STRAIN[::2]),
    "rows left out": lambda load: (
        np.delete(load, slice(50, 90)),
        np.delete(STRAIN, slice(50, 90)),
    ),
    "last digits lost": lambda load: (np.round(load, 1), STRAIN),
}


@pytest.mark.parametrize("change", CHANGES, ids=lambda name: name)
def test_a_changed_copy_is_found(tmp_path, change):
    load = record_of(1)
    copies = ChangedCopies()
    assert not copies.earlier("A", sketch_of(load, STRAIN, tmp_path))
    assert not copies.earlier("B", sketch_of(record_of(2), STRAIN, tmp_path))
    assert copies.earlier("C", sketch_of(*CHANGES[change](load), tmp_path)) == "A"


@settings(max_examples=25, deadline=None)
@given(seed=st.integers(0, 10_000), digits=st.integers(3, 8))
def test_specimens_on_one_ramp_of_strain_are_not_copies(tmp_path_factory, seed, digits):
    """Even with a coarse load cell, and with strains that are equal to the last digit."""
    path = tmp_path_factory.getbasetemp()
    copies = ChangedCopies()
    found = [
        copies.earlier(str(k), sketch_of(np.round(record_of(seed + k), digits - 5), STRAIN, path))
        for k in range(6)
    ]
    assert found == [""] * 6


def test_idle_readings_and_short_records_have_no_sketch(tmp_path):
    assert sketch_of(1.2e6 * STRAIN, STRAIN, tmp_path) == ()
    assert sketch_of(np.zeros(100), np.zeros(100), tmp_path) == ()
    assert sketch_of(record_of(1)[:30], STRAIN[:30], tmp_path) == ()
