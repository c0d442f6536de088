"""Outlines of cells: closed lines of the edges that belong to one cell only."""

import numpy as np
import pytest

from nptcs.fe.output.outlines import outlines


def grid(columns, rows):
    """Unit squares side by side, corners in order around each."""
    square = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
    return np.array([square + [x, y] for y in range(rows) for x in range(columns)])


def area(points):
    x, y = points.T
    return 0.5 * abs(np.dot(x, np.roll(y, -1)) - np.dot(y, np.roll(x, -1)))


@pytest.mark.parametrize(("columns", "rows"), [(1, 1), (3, 2), (5, 4)])
def test_the_outline_of_a_grid_has_its_length_and_area(columns, rows):
    cells = grid(columns, rows)
    (line,) = outlines(cells)
    points = cells.reshape(-1, 2)[line]
    steps = np.hypot(*(np.roll(points, -1, axis=0) - points).T)
    np.testing.assert_allclose(steps, 1.0)
    assert len(line) == 2 * (columns + rows)
    assert area(points) == pytest.approx(columns * rows)


def test_a_hole_and_a_separate_part_have_their_own_lines():
    cells = grid(3, 3)
    ring = np.delete(cells, 4, axis=0)
    apart = cells[:1] + [10.0, 0.0]
    areas = sorted(
        area(np.concatenate([ring, apart]).reshape(-1, 2)[line])
        for line in outlines(np.concatenate([ring, apart]))
    )
    assert areas == [1.0, 1.0, 9.0]


def test_the_indices_of_an_outline_also_serve_the_moved_cells():
    cells = grid(2, 1)
    (line,) = outlines(cells)
    moved = cells * [2.0, 1.0] + [0.3 * 1.0, 0.0]
    assert area(moved.reshape(-1, 2)[line]) == pytest.approx(4.0)
