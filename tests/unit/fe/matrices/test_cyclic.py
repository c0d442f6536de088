import numpy as np
import pytest

from nptcs.fe.matrices.cyclic import BandedPattern


def test_banded_assembly_equals_the_dense_one():
    rng = np.random.default_rng(0)
    dofs = np.array([[0, 1, 2], [2, 3, -1]])
    blocks = rng.normal(size=(2, 3, 3))
    dense = np.zeros((4, 4))
    dense[:3, :3] += blocks[0]
    dense[np.ix_([2, 3], [2, 3])] += blocks[1][:2, :2]
    dense += 5.0 * np.eye(4)
    pattern = BandedPattern([dofs, np.arange(4)[:, None]], 4)
    band = pattern.assemble([blocks, 5.0 * np.ones((4, 1, 1))])
    rhs = rng.normal(size=4)
    assert pattern.solve(band, rhs) == pytest.approx(np.linalg.solve(dense, rhs))
