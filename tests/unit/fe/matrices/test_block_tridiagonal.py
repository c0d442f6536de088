import numpy as np
import pytest

from nptcs.fe.matrices.block_tridiagonal import BlockCholesky, BlockPattern, solve_indefinite

ROW = 3


def chain(rows, shift):
    """Elements over three rows each, from the clamped row before the first unknown one on."""
    rng = np.random.default_rng(1)
    size = ROW * rows
    dofs = np.array([np.arange(2 * ROW * e, 2 * ROW * (e + 1) + ROW) - ROW for e in range(99)])
    dofs = dofs[(dofs < size).any(axis=1)]
    dofs = np.where((dofs < 0) | (dofs >= size), -1, dofs)
    tangents = rng.normal(size=(len(dofs), 3 * ROW, 3 * ROW))
    tangents = tangents + tangents.swapaxes(1, 2) + shift * np.eye(3 * ROW)
    dense = np.zeros((size, size))
    for own, tangent in zip(dofs, tangents, strict=True):
        kept = np.flatnonzero(own >= 0)
        dense[np.ix_(own[kept], own[kept])] += tangent[np.ix_(kept, kept)]
    return BlockPattern([dofs], ROW, size), [tangents], dense, rng.normal(size=(size, 2))


@pytest.mark.parametrize("rows", [1, 2, 7, 8])
def test_a_chain_is_solved_as_the_dense_matrix(rows):
    pattern, tangents, dense, rhs = chain(rows, 20.0)
    factor = BlockCholesky(pattern.assemble(tangents))
    assert factor.solve(rhs) == pytest.approx(np.linalg.solve(dense, rhs))
    assert factor.solve(rhs[:, 0]) == pytest.approx(np.linalg.solve(dense, rhs[:, 0]))


def test_an_indefinite_chain_is_refused_by_cholesky_and_solved_by_elimination():
    pattern, tangents, dense, rhs = chain(7, 0.0)
    assert np.linalg.eigvalsh(dense).min() < 0.0 < np.linalg.eigvalsh(dense).max()
    with pytest.raises(np.linalg.LinAlgError, match="not positive definite"):
        BlockCholesky(pattern.assemble(tangents))
    solved = solve_indefinite(pattern.assemble(tangents), rhs)
    assert solved == pytest.approx(np.linalg.solve(dense, rhs))


def test_elements_that_join_rows_apart_are_refused():
    with pytest.raises(ValueError, match="not neighbours"):
        BlockPattern([np.arange(ROW * 3)[None]], ROW, ROW * 3)
