"""The digest by which repeated data are found."""

from __future__ import annotations

import numpy as np
import pytest

from nptcs.ingest.repeats import data_digest


def digest(read, factor: float, decimals: int = 12) -> str:
    force = factor * np.linspace(1, 9, 12)
    lines = ["time_s,force_N,strain_%"]
    lines += [f"{i},{v:.{decimals}g},{0.01 * i:g}" for i, v in enumerate(force, 1)]
    return data_digest([read("\n".join(lines))])


@pytest.mark.parametrize("factor", [1e-3, 1e3, 1e-200, 1e150])
def test_a_factor_of_ten_does_not_change_it(read, factor):
    assert digest(read, factor) == digest(read, 1.0)


def test_other_digits_change_it(read):
    assert digest(read, 1.000001) != digest(read, 1.0)


def test_readings_next_to_zero_do_not_stop_it(read):
    assert digest(read, 1e-315) != digest(read, 1.0)
