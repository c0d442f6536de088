"""Responses of a loaded tyre from arrays."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from nptcs.fe.spoke.energy_table import SpokeEnergyTable
from nptcs.fe.tyre.contact import ContactCells
from nptcs.fe.tyre.responses import contact_responses, deciding_spokes, spoke_forces

# E = 5 s² + 1000 β² + 1000 φ², written in Chebyshev terms on [-10, 10] × [-1, 1]²; springs have
# no legs that could straighten
TABLE = SpokeEnergyTable(
    84.0, 1e12, np.array([-10.0, -1, -1]), np.array([10.0, 1, 1]),
    np.array([(0, 0, 0), (2, 0, 0), (0, 2, 0), (0, 0, 2)]),
    np.array([1250.0, 250.0, 500.0, 500.0]), 1.0, 0.0,
)  # fmt: skip


def cells(edges, pressure):
    """Contact cells between edges, as long on the ground as when unloaded."""
    return ContactCells(edges[:-1], edges[1:], np.asarray(pressure, float), np.diff(edges))


@pytest.mark.parametrize("count", [6, 12, 600])
def test_an_even_pressure_has_its_own_length_on_any_mesh(count):
    found = contact_responses(cells(np.linspace(7.0, 47.0, count + 1), np.full(count, 0.5)))
    assert found["contact_length_mm"] == pytest.approx(40.0)
    assert found["mean_pressure_mpa"] == pytest.approx(0.5)
    assert found["largest_pressure_mpa"] == pytest.approx(0.5)
    assert found["contact_cells"] == pytest.approx(count)


def test_uneven_points_count_with_their_length():
    edges = np.concatenate([np.linspace(0, 10, 5)[:-1], np.linspace(10, 40, 200)])
    found = contact_responses(cells(edges, np.full(len(edges) - 1, 0.5)))
    assert found["contact_length_mm"] == pytest.approx(40.0)


@given(
    st.lists(st.tuples(st.floats(0.1, 10.0), st.floats(0.0, 2.0)), min_size=4, max_size=30).filter(
        lambda parts: any(pressure > 1e-3 for _, pressure in parts)
    )
)
def test_the_mean_pressure_never_exceeds_the_largest(parts):
    """Of all pressures below a bound the even one has the least variance."""
    widths, pressure = np.array(parts).T
    found = contact_responses(cells(np.concatenate([[0.0], np.cumsum(widths)]), pressure))
    if "mean_pressure_mpa" in found:
        assert found["mean_pressure_mpa"] <= found["largest_pressure_mpa"] * (1.0 + 1e-9)


@pytest.mark.parametrize("phase", [0.0, 0.25, 0.5, 0.9])
def test_the_length_does_not_jump_as_the_contact_moves_over_the_points(phase):
    """A parabola of 40 mm, √(12/5)·20 = 30.98, on points 5.5 mm apart."""
    edges = 5.5 * (np.arange(-12, 13) + phase)
    middle = 0.5 * (edges[1:] + edges[:-1])
    found = contact_responses(cells(edges, np.clip(1.0 - (middle / 20.0) ** 2, 0.0, None)))
    assert found["contact_length_mm"] == pytest.approx(np.sqrt(12.0 / 5.0) * 20.0, rel=0.04)


def test_too_few_points_give_no_length():
    found = contact_responses(cells(np.linspace(0.0, 30.0, 4), [0.1, 0.5, 0.1]))
    assert set(found) == {"contact_cells"}
    assert found["contact_cells"] < 3.0


def test_a_tyre_off_the_ground_has_no_contact():
    assert contact_responses(cells(np.arange(4.0), np.zeros(3))) == {}


def test_spoke_forces_are_those_of_the_energy():
    motion = np.array([[-3.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 0.0, 0.0]])
    forces = spoke_forces(TABLE, motion)
    assert forces["smallest_spoke_force_n"] == pytest.approx(-30.0)
    assert forces["largest_spoke_force_n"] == pytest.approx(20.0)


def test_the_spokes_that_decide_store_most_energy():
    motion = np.array([[-3.0, 0, 0], [-1.0, 0, 0], [-2.9, 0, 0], [3.1, 0, 0]])
    assert deciding_spokes(TABLE, motion).tolist() == [3, 0, 2]
