"""Readings of a channel that leap away for a while."""

import numpy as np
import pytest

from nptcs.ingest.conditioning.excursions import find_excursions


@pytest.mark.parametrize("height", [1e4, 1e200, -1e200])
def test_readings_that_leap_away_and_come_back_are_marked_however_far(height):
    force = np.linspace(0.0, 1000.0, 200)
    force[100:102] = height
    with np.errstate(over="raise"):
        gone = find_excursions(force, None, before_break=True)
    assert np.flatnonzero(gone).tolist() == [100, 101]
