"""Force and strain from two files: offsets, rates, units, lost frames."""

from __future__ import annotations

import numpy as np
import pytest

from nptcs.config.materials.ingest import Pairing
from nptcs.errors import InputError
from nptcs.ingest.conditioning.pairing import pair

DURATION = 100.0
MODULUS_N = 1e6
"""Force per strain."""


def strain_at(time):
    """At rest for 5 s, then a ramp to 1 %, then broken."""
    return np.where(time < DURATION, 0.0001 * np.clip(time - 5, 0, None), 0.0)


def machine(read, rate=10.0, **changes):
    time = np.arange(0, DURATION + 3, 1 / rate)
    return csv(
        read, "machine.csv", {"time (s)": time, "force (N)": MODULUS_N * strain_at(time)}, "force"
    )


def camera(
    read, rate=2.0, offset=0.0, force_unit=None, columns=("eyy [1]", "exx [1]"), end=DURATION
):
    clock = np.arange(0, end, 1 / rate)
    strain = strain_at(clock)
    data = {"time (s)": clock - offset, columns[0]: strain, columns[1]: -0.3 * strain}
    if force_unit is not None:
        scale = {"N": 1, "kN": 1e-3, "": 1e-3}[force_unit]
        data[f"force ({force_unit})" if force_unit else "force"] = scale * MODULUS_N * strain
    return csv(read, "camera.csv", data, "strain")


def csv(read, name, data, role):
    rows = zip(*data.values(), strict=True)
    lines = [";".join(data), *(";".join(f"{value:.9g}" for value in row) for row in rows)]
    return read("\n".join(lines), name=name, role=role)


def slope(signals, name="strain_yy"):
    strain, force = signals.values[name], signals.values["force"]
    used = (strain > 0.001) & (strain < 0.009) & ~np.isnan(force)
    return np.polyfit(strain[used], force[used], 1)[0]


@pytest.mark.parametrize(("force_rate", "strain_rate"), [(10, 2), (10, 10), (2, 25), (50, 1)])
def test_rates_that_differ_leave_the_slope(read, force_rate, strain_rate):
    signals = pair(machine(read, force_rate), camera(read, strain_rate), None, Pairing(), "A")
    assert slope(signals) == pytest.approx(MODULUS_N, rel=1e-6)
    assert len(signals) <= (DURATION + 3) * min(force_rate, strain_rate) + 2


def test_largest_force_survives_a_slow_camera(read):
    fast = machine(read, 10)
    signals = pair(fast, camera(read, 0.5), None, Pairing(), "A")
    assert np.nanmax(signals.values["force"]) == fast.values["force"].max()


def test_stated_offset(read):
    signals = pair(machine(read), camera(read, offset=7.3), 7.3, Pairing(), "A")
    assert slope(signals) == pytest.approx(MODULUS_N, rel=1e-6)
    assert signals.values["strain_yy"][20] == pytest.approx(
        signals.values["force"][20] / MODULUS_N, abs=1e-9
    )


def test_clocks_that_differ_are_refused_with_the_offset(read):
    with pytest.raises(InputError, match=r"time_offset_s in the sheet \(about 20\.0"):
        pair(machine(read), camera(read, offset=20.0), None, Pairing(), "A")


@pytest.mark.parametrize("unit", ["N", "kN", ""])
def test_offset_from_the_shared_force(read, unit):
    signals = pair(machine(read), camera(read, offset=-13.7, force_unit=unit), None, Pairing(), "A")
    assert signals.steps[0].numbers["offset_s"] == pytest.approx(-13.7, abs=0.02)
    assert slope(signals) == pytest.approx(MODULUS_N, rel=1e-3)


def test_forces_that_disagree_are_refused_with_both_units(read):
    strain = camera(read, force_unit="kN")
    strain.values["force"] = strain.values["force"] * 1000
    with pytest.raises(InputError, match=r"read as kN.*read as N"):
        pair(machine(read), strain, None, Pairing(), "A")


def test_force_without_unit_that_fits_no_unit_is_refused(read):
    strain = camera(read, force_unit="")
    strain.values["force"] = strain.values["force"] * 7
    with pytest.raises(InputError, match="fits the machine's"):
        pair(machine(read), strain, None, Pairing(), "A")


def test_pairing_by_force_without_time_keeps_the_machines_peak(read):
    strain = camera(read, 0.5, force_unit="N")
    del strain.values["time"]
    force = machine(read)
    signals = pair(force, strain, None, Pairing(), "A")
    assert np.nanmax(signals.values["force"]) == force.values["force"].max()
    assert slope(signals) == pytest.approx(MODULUS_N, rel=1e-6)


def test_nothing_in_common_is_refused(read):
    strain = camera(read)
    del strain.values["time"]
    with pytest.raises(InputError, match="neither time nor force"):
        pair(machine(read), strain, None, Pairing(), "A")


def test_time_that_goes_back_is_refused(read):
    force = machine(read)
    force.values["time"][50:] -= 10
    with pytest.raises(InputError, match="does not increase from reading 50 to 51"):
        pair(force, camera(read), None, Pairing(), "A")


def test_lost_frames_are_not_bridged(read):
    strain = camera(read, 10)
    strain.values["strain_yy"][300:400] = np.nan
    signals = pair(machine(read, 2), strain, None, Pairing(), "A")
    lost = (signals.values["time"] > 30.2) & (signals.values["time"] < 39.8)
    assert np.isnan(signals.values["strain_yy"][lost]).all()
    assert not np.isnan(signals.values["strain_xx"][lost]).any()


def test_nothing_is_extrapolated_after_the_last_frame(read):
    signals = pair(machine(read, 1), camera(read, 2, end=60), None, Pairing(), "A")
    late = signals.values["time"] > 60
    assert late.any()
    assert np.isnan(signals.values["strain_yy"][late]).all()
