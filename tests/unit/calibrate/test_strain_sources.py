"""Curves from crosshead travel are not fitted together with those of a sensor."""

from collections.abc import Callable
from typing import Any

import pytest

from nptcs.calibrate.strain_sources import without_travel_next_to_sensors

Make = Callable[..., Any]


@pytest.mark.parametrize("sensor", ["extensometer", "dic", "strain_gauge", "unspecified"])
def test_travel_next_to_a_sensor_is_left_out_by_name(make_rubber: Make, sensor: str) -> None:
    sheet = [make_rubber(specimen=name) for name in ("R-1", "R-2")]
    sources = {"R-1": sensor, "R-2": "crosshead"}
    kept, words = without_travel_next_to_sensors("rubber_75A", sheet, sources)
    assert [s.specimen for s in kept] == ["R-1"]
    assert words == ["R-2: crosshead strain, where other specimens have a sensor: not in the fit"]


def test_travel_is_kept_where_no_specimen_has_a_sensor(make_rubber: Make) -> None:
    sheet = [make_rubber(specimen=name) for name in ("R-1", "R-2")]
    sources = {"R-1": "crosshead", "R-2": "crosshead"}
    assert without_travel_next_to_sensors("rubber_75A", sheet, sources) == (sheet, [])


def test_a_sensor_of_a_specimen_that_is_left_out_decides_nothing(make_rubber: Make) -> None:
    sheet = [
        make_rubber(specimen="R-1", include=False, reason="slipped"),
        make_rubber(specimen="R-2"),
    ]
    sources = {"R-1": "dic", "R-2": "crosshead"}
    assert without_travel_next_to_sensors("rubber_75A", sheet, sources) == (sheet, [])
