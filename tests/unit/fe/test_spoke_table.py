import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from nptcs.config.fe import FeModel, SpokeGeometry, SpokeMesh, SpokeTableOptions
from nptcs.fe.cache import read_table, shared_table, table_key
from nptcs.fe.calibration import PUBLISHED_PLY
from nptcs.fe.spoke import SpokeDesign, SpokeModel
from nptcs.fe.spoke_table import SpokeSamples, TableRangeError, chebyshev_nodes, fit, sample

OPTIONS = SpokeTableOptions(
    u_r_mm=(-6.0, 3.0), u_theta_mm=(-2.0, 2.0), phi_rad=(-0.04, 0.04), samples=(4, 3, 3),
    degrees=(6, 4), narrowing=1.0,
)  # fmt: skip
SAMPLE_FIELDS = ("motion", "energy", "force", "tangent")
COARSE = SpokeMesh(rows=(1, 1, 1, 1, 1, 1))


def manufactured(motion):
    """E = u² (1 + v/10) + 300 φ² + 2 u φ, with its derivatives."""
    u, v, phi = motion.T
    energy = u**2 * (1 + v / 10) + 300 * phi**2 + 2 * u * phi
    force = np.stack([2 * u * (1 + v / 10) + 2 * phi, u**2 / 10, 600 * phi + 2 * u], axis=1)
    tangent = np.zeros((len(motion), 3, 3))
    tangent[:, 0, 0] = 2 * (1 + v / 10)
    tangent[:, 0, 1] = tangent[:, 1, 0] = u / 5
    tangent[:, 2, 2] = 600
    tangent[:, 0, 2] = tangent[:, 2, 0] = 2
    return SpokeSamples(motion, energy, force, tangent)


def grid_samples():
    lines = [
        chebyshev_nodes(*limits, count)
        for limits, count in zip(
            (OPTIONS.u_r_mm, OPTIONS.u_theta_mm, OPTIONS.phi_rad), OPTIONS.samples, strict=True
        )
    ]
    return manufactured(np.stack(np.meshgrid(*lines), axis=-1).reshape(-1, 3))


TABLE = fit(grid_samples(), OPTIONS)


@given(st.floats(-6.0, 3.0), st.floats(-2.0, 2.0), st.floats(-0.04, 0.04))
@settings(max_examples=40, deadline=None)
def test_a_polynomial_energy_is_recovered_everywhere(u_r, u_theta, phi):
    motion = np.array([[u_r, u_theta, phi]])
    energy, force, tangent = TABLE.evaluate(motion)
    wanted = manufactured(motion)
    assert energy == pytest.approx(wanted.energy, abs=1e-8)
    assert force == pytest.approx(wanted.force, abs=1e-6)
    assert tangent == pytest.approx(wanted.tangent, abs=1e-4)


def test_leaving_the_table_is_an_error_that_names_the_spoke():
    motion = np.array([[0.0, 0.0, 0.0], [-7.0, 0.0, 0.0]])
    with pytest.raises(TableRangeError, match=r"spoke 1: u_r \(mm\) = -7"):
        TABLE.evaluate(motion)
    with pytest.raises(TableRangeError):
        TABLE.evaluate(np.array([[np.nan, 0.0, 0.0]]))


def test_more_terms_than_data_are_refused():
    few = OPTIONS.model_copy(update={"degrees": (6, 12)})
    with pytest.raises(ValueError, match="lower degrees"):
        fit(grid_samples(), few)


def test_a_table_that_ends_early_has_a_lower_degree():
    samples = grid_samples()
    kept = samples.motion[:, 0] > -4.0
    short = SpokeSamples(*(getattr(samples, name)[kept] for name in SAMPLE_FIELDS))
    table = fit(short, OPTIONS)
    assert table.exponents[:, 0].max() == 4
    assert table.low[0] > -4.0


def spoke_design(**change):
    values = {
        "geometry": SpokeGeometry(),
        "mesh": COARSE,
        "pitch_mm": 15.0,
        "plate_width_mm": 5.0,
        "thickness_mm": 1.8,
        "angle_deg": 45.0,
        "c10_mpa": 1.0,
        "ply": PUBLISHED_PLY,
        "plates": 14,
    }
    return SpokeDesign(**{**values, **change})


def test_the_table_of_a_spoke_predicts_states_between_its_samples():
    model = SpokeModel(spoke_design())
    table = fit(sample(model, OPTIONS), OPTIONS)
    for motion in ([-4.1, 1.3, 0.02], [1.9, -0.7, -0.03]):
        state = model.move(model.rest(), np.array(motion))
        energy, force, _ = table.evaluate(np.array([motion]))
        assert energy[0] == pytest.approx(state.energy, rel=2e-3)
        assert force[0, 0] == pytest.approx(state.force[0], rel=5e-3)


def test_equal_spokes_share_one_file(tmp_path, monkeypatch):
    calls = []

    def computed(model, design):
        calls.append(design)
        return TABLE

    monkeypatch.setattr("nptcs.fe.cache.spoke_table", computed)
    model = FeModel(spoke_mesh=COARSE, table=OPTIONS)
    first = shared_table(model, spoke_design(), tmp_path)
    again = shared_table(model, spoke_design(), tmp_path)
    assert len(calls) == 1
    assert again.coefficients == pytest.approx(first.coefficients, rel=0, abs=0)
    shared_table(model, spoke_design(c10_mpa=2.0), tmp_path)
    assert len(calls) == 2
    assert len(list(tmp_path.iterdir())) == 2
    path = tmp_path / f"{table_key(spoke_design(), OPTIONS)}.npz"
    assert read_table(path).force_residual_n == TABLE.force_residual_n


def test_every_part_of_the_design_is_in_the_key():
    base = table_key(spoke_design(), OPTIONS)
    other_ply = {**PUBLISHED_PLY, "g23_mpa": 2301.0}
    changes = [
        {"angle_deg": 46.0},
        {"ply": other_ply},
        {"geometry": SpokeGeometry(block_thickness_mm=12.5)},
        {"mesh": SpokeMesh()},
        {"plates": 13},
    ]
    keys = {table_key(spoke_design(**change), OPTIONS) for change in changes}
    keys.add(table_key(spoke_design(), SpokeTableOptions()))
    assert len(keys) == 6
    assert base not in keys
