"""Responses of a loaded tyre from arrays."""

import numpy as np
import pytest

from nptcs.fe.spoke.energy_table import SpokeEnergyTable
from nptcs.fe.tyre.responses import contact_responses, deciding_spokes, spoke_forces

# E = 5 s² + 1000 β² + 1000 φ², written in Chebyshev terms on [-10, 10] × [-1, 1]²
TABLE = SpokeEnergyTable(
    84.0, np.array([-10.0, -1, -1]), np.array([10.0, 1, 1]),
    np.array([(0, 0, 0), (2, 0, 0), (0, 2, 0), (0, 0, 2)]),
    np.array([1250.0, 250.0, 500.0, 500.0]), 1.0, 0.0,
)  # fmt: skip


@pytest.mark.parametrize("points", [12, 60, 600])
def test_an_even_pressure_has_its_own_length_at_any_mesh(points):
    place = (np.arange(points) + 0.5) / points * 40.0 + 7.0
    length = np.full(points, 40.0 / points)
    found = contact_responses(place, np.full(points, 0.5), length)
    assert found["contact_length_mm"] == pytest.approx(40.0, rel=0.01)
    assert found["mean_pressure_mpa"] == pytest.approx(0.5, rel=0.01)
    assert found["largest_pressure_mpa"] == 0.5


def test_uneven_points_count_with_their_length():
    edges = np.concatenate([np.linspace(0, 10, 5)[:-1], np.linspace(10, 40, 200)])
    place, length = 0.5 * (edges[1:] + edges[:-1]), np.diff(edges)
    found = contact_responses(place, np.full(len(place), 0.5), length)
    assert found["contact_length_mm"] == pytest.approx(40.0, rel=0.01)


def test_a_tyre_off_the_ground_has_no_contact():
    assert contact_responses(np.arange(3.0), np.zeros(3), np.ones(3)) == {}


def test_spoke_forces_are_those_of_the_energy():
    motion = np.array([[-3.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 0.0, 0.0]])
    forces = spoke_forces(TABLE, motion)
    assert forces["smallest_spoke_force_n"] == pytest.approx(-30.0)
    assert forces["largest_spoke_force_n"] == pytest.approx(20.0)


def test_the_spokes_that_decide_store_most_energy():
    motion = np.array([[-3.0, 0, 0], [-1.0, 0, 0], [-2.9, 0, 0], [3.1, 0, 0]])
    assert deciding_spokes(TABLE, motion).tolist() == [3, 0, 2]
