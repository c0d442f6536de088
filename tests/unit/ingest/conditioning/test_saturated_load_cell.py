"""A load cell at the end of its range gives no strength; a maximum of the material does."""

from __future__ import annotations

import numpy as np
import pytest

from nptcs.ingest.conditioning.saturation import saturated_from

E_MPA, ROWS = 60_000.0, 600
STRAIN = np.append(np.linspace(0, 0.015, ROWS), np.full(10, 0.003))
FORCE = np.append(10 * E_MPA * STRAIN[:ROWS], np.full(10, 5.0))
NOISE = np.random.default_rng(7).standard_normal(len(FORCE))


def ingested(lab, folder, force, strain=STRAIN, **fields):
    columns = {
        "Time [s]": np.arange(len(force)) / 10,
        "Load [N]": force,
        "Strain [%]": 100 * strain,
    }
    lab.write(folder / "a.csv", columns)
    return lab.ingest(folder, "a.csv", **fields)


@pytest.mark.parametrize("limit", [4000.0, 7000.0, 8500.0])
@pytest.mark.parametrize("sign", [1, -1])
def test_a_saturated_load_cell_is_cut_and_shows_no_failure(lab, tmp_path, limit, sign):
    force = np.minimum(FORCE + NOISE, limit)
    test = "tension" if sign > 0 else "compression"
    done = ingested(lab, tmp_path, sign * force, sign * STRAIN, test=test)
    assert lab.flagged(done, "load cell saturated")
    assert not done.record.failure_seen
    assert lab.modulus(done) == pytest.approx(E_MPA, rel=2e-3)
    assert done.curve["strain_axial"].abs().max() == pytest.approx(limit / 10 / E_MPA, rel=0.01)


def test_a_saturated_channel_may_flicker_in_its_last_digit(lab, tmp_path):
    flicker = np.random.default_rng(3).integers(0, 2, len(FORCE))
    done = ingested(lab, tmp_path, np.where(FORCE > 5000, 5000 - flicker, FORCE))
    assert lab.flagged(done, "load cell saturated")
    assert not done.record.failure_seen


def test_a_saturated_load_cell_is_found_by_the_travel_alone(lab, tmp_path):
    columns = {
        "Time [s]": np.arange(len(FORCE)) / 10,
        "Load [N]": np.minimum(FORCE + NOISE, 6000),
        "Crosshead [mm]": np.linspace(0, 3, len(FORCE)),
    }
    lab.write(tmp_path / "a.csv", columns)
    done = lab.ingest(tmp_path, "a.csv")
    assert lab.flagged(done, "load cell saturated")


HELD = np.append(np.linspace(0, 0.01, 400), np.full(200, 0.01))
YIELDED = np.linspace(0, 0.05, 600)


@pytest.mark.parametrize(
    ("load", "strain"),
    [
        (FORCE, STRAIN),
        (FORCE + NOISE, STRAIN),
        (6e5 * HELD, HELD),
        (np.round(6000 * np.tanh(YIELDED / 0.01) / 50) * 50, YIELDED),
        (np.round(6000 * np.sin(40 * YIELDED), -1), YIELDED),
        (np.repeat(np.linspace(0, 6000, 60), 10), YIELDED),
    ],
    ids=["broken", "noise", "held", "coarse plateau", "coarse maximum", "steps"],
)
def test_other_records_are_not_taken_for_saturation(load, strain):
    assert saturated_from(load, strain) is None
