"""The surrogate as a file and a command, tables of different ranges, and spokes left out."""

import json
from dataclasses import replace

import numpy as np
import pandas as pd
import pytest

from nptcs.cli import main
from nptcs.config.solvers.ring import RingElements, RingModel
from nptcs.config.solvers.tyre import TyreGeometry
from nptcs.errors import InputError
from nptcs.ring.surrogate.common_range import on_common_range
from nptcs.ring.surrogate.left_out import left_out_spokes
from nptcs.ring.surrogate.model import DESIGN, SpokeSurrogate
from nptcs.ring.surrogate.stored import StoredSurrogate, dump_surrogate, read_surrogate
from nptcs.tables.laboratory.material_card import PUBLISHED_PLY

MODEL = RingModel(mesh=RingElements(elements_per_pitch=1))
BETWEEN = [16.0, 1.7, 40.0, 2.2]
MOTIONS = np.array([[-8.0, 2.0, 0.03], [3.0, -4.0, -0.02], [-20.0, 0.0, 0.05]])


@pytest.fixture(scope="module")
def surrogate(table, designs, law):
    return SpokeSurrogate(designs, [law(design, table) for design in designs], PUBLISHED_PLY)


@pytest.fixture(scope="module")
def file(surrogate, tmp_path_factory):
    path = tmp_path_factory.mktemp("surrogate") / "surrogate.json"
    path.write_text(dump_surrogate(StoredSurrogate(surrogate, TyreGeometry(), MODEL, "joint")))
    return path


def test_it_is_read_back_from_its_file(surrogate, file):
    again = read_surrogate(file)
    assert again.study == "joint"
    assert again.model == MODEL
    old, new = surrogate.predict(BETWEEN), again.surrogate.predict(BETWEEN)
    np.testing.assert_allclose(new.table.coefficients, old.table.coefficients, rtol=1e-9)
    # the sign of a principal component is free
    np.testing.assert_allclose(np.abs(new.modes), np.abs(old.modes), rtol=1e-5, atol=1e-9)


def test_an_edited_file_is_refused(file, tmp_path):
    content = json.loads(file.read_text())
    content["coefficients"][0][0] *= 2
    (tmp_path / "s.json").write_text(json.dumps(content))
    with pytest.raises(InputError, match="cannot be used"):
        read_surrogate(tmp_path / "s.json")


def test_a_shorter_range_has_the_same_energy(table):
    short = replace(table, low=np.array([-25.0, *table.low[1:]]))
    both = on_common_range([table, short])
    assert np.array_equal(both[1].low, short.low)
    np.testing.assert_allclose(both[1].coefficients, short.coefficients, atol=1e-8)
    assert both[0].low[0] == -25.0
    for found, true in zip(both[0].evaluate(MOTIONS), table.evaluate(MOTIONS), strict=True):
        np.testing.assert_allclose(found, true, rtol=1e-9, atol=1e-8 * np.abs(true).max())
    # the sides narrow towards the lowest s as they did there before
    part = 1 - (1 - table.narrowing) * 25.0 / 40.0
    assert both[0].narrowing == pytest.approx(part)


def test_terms_that_a_table_lacks_are_zero_there(table):
    keep = table.exponents[:, 0] <= 5
    poor = replace(table, exponents=table.exponents[keep], coefficients=table.coefficients[keep])
    both = on_common_range([poor, table])
    assert np.array_equal(both[0].exponents, both[1].exponents)
    np.testing.assert_allclose(both[0].evaluate(MOTIONS)[0], poor.evaluate(MOTIONS)[0], rtol=1e-9)


def test_neighbours_of_a_spoke_that_buckles_are_refused(surrogate):
    buckled = np.array([[21.0, 1.25, 6.0, 2.0]])
    other = SpokeSurrogate(
        surrogate.designs, surrogate.tables, PUBLISHED_PLY, surrogate.kernels, buckled
    )
    other.predict(BETWEEN)
    with pytest.raises(InputError, match="loses its stability"):
        other.predict(buckled[0])


def test_spokes_left_out_are_predicted_within_their_errors(surrogate):
    found = left_out_spokes(surrogate, TyreGeometry(), MODEL)
    assert found.percent.shape == (64, 4)
    assert 0.0 < found.rms() < found.largest() < 5.0
    assert np.nanmax(np.abs(found.percent[found.worst()])) == found.largest()
    known = found.standard_errors[np.isfinite(found.standard_errors)]
    assert np.mean(np.abs(known) < 3) > 0.8


def test_the_command_solves_a_table_and_refuses_what_is_outside(file, tmp_path, capsys):
    row = {**dict(zip(DESIGN, BETWEEN, strict=True)), "shear_band_c10_mpa": 5.0, "load_n": 1000.0}
    rows = pd.DataFrame([row, {**row, "plate_count": 40}])
    rows.to_csv(tmp_path / "d.csv", index=False)
    command = ["surrogate", "solve", str(tmp_path / "d.csv"), "--surrogate", str(file)]
    assert main([*command, "-o", str(tmp_path / "out.csv")]) == 1
    out = pd.read_csv(tmp_path / "out.csv")
    assert out["status"].tolist() == ["ok", "bad_input"]
    assert out["displacement_standard_error_mm"].iloc[0] > 0
    assert "1 without a result" in capsys.readouterr().out
    assert main([*command[:2], str(tmp_path / "none.csv"), "-o", "x", *command[3:]]) == 2


def test_spokes_that_differ_by_a_power_law_are_predicted_exactly(table, designs):
    """Outside the box, too: components of absolute size would miss the soft ones."""

    def of(design):
        plates, thickness, _, c10 = design
        return replace(table, coefficients=table.coefficients * plates * thickness**2 * c10**0.6)

    surrogate = SpokeSurrogate(designs, [of(design) for design in designs], PUBLISHED_PLY)
    soft = np.array([9.0, 1.0, 95.0, 6.0])
    found = surrogate.predict_anywhere(soft).table.coefficients
    np.testing.assert_allclose(found, of(soft).coefficients, rtol=1e-6)
