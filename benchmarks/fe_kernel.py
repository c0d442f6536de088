"""Assembly and factorisation of the spoke, side by side with other solvers and with FElupe.

    python benchmarks/fe_kernel.py

Processor time of one call, the mean of ten; FElupe and pypardiso if they are installed. `--mesh`
takes a mesh of ``fe_mesh.py``. The figures are in ``docs/decisions/0003-fe-kernel.md``.
"""

from __future__ import annotations

import argparse
import importlib.util
import time
from collections.abc import Callable

import numpy as np
import scipy.sparse as sparse
from fe_mesh import SPOKE_MESHES
from numpy.typing import NDArray
from scipy.linalg import cholesky_banded
from scipy.sparse.linalg import splu
from threadpoolctl import threadpool_limits

from nptcs.config.solvers.fe import FeModel
from nptcs.config.solvers.tyre import TyreGeometry
from nptcs.fe.case import spoke_design
from nptcs.fe.elements.groups import element_dofs
from nptcs.fe.matrices.block_tridiagonal import BlockCholesky, BlockMatrix, BlockPattern
from nptcs.fe.spoke.equilibrium import SpokeModel
from nptcs.tables.laboratory.material_card import PUBLISHED_PLY

Array = NDArray[np.float64]
Index = NDArray[np.int64]

REPEATS = 10


def milliseconds(call: Callable[[], object]) -> float:
    """Processor time of one call, after one to warm up."""
    call()
    start = time.process_time()
    for _ in range(REPEATS):
        call()
    return 1000.0 * (time.process_time() - start) / REPEATS


@threadpool_limits.wrap(limits=1)
def own_kernel(mesh: str) -> None:
    """Time our assembly, and our factorisation against others of the same matrix."""
    fiducial = {"spacing_mm": 15.0, "thickness_mm": 1.8, "angle_deg": 45.0, "spoke_c10_mpa": 1.0}
    model = SpokeModel(
        spoke_design(
            FeModel(spoke_mesh=SPOKE_MESHES[mesh]), TyreGeometry(), PUBLISHED_PLY, fiducial
        )
    )
    rest = np.zeros_like(model.mesh.positions)
    bricks = model.rubbers[0]
    spent = milliseconds(lambda: bricks.respond(rest))
    print(f"{len(bricks.nodes)} bricks, own blocks: {spent:.1f} ms")
    blocks = model.groups
    print(f"whole spoke: {milliseconds(lambda: [b.respond(rest) for b in blocks]):.1f} ms")
    row = 3 * model.mesh.nodes_per_row
    size = rest.size - 2 * row
    number = np.arange(rest.size) - row
    number[(number < 0) | (number >= size)] = -1
    dofs = [number[element_dofs(block.nodes, 3)] for block in blocks]
    factorisations(dofs, [block.respond(rest).tangent for block in blocks], row, size)


def factorisations(dofs: list[Index], tangents: list[Array], row: int, size: int) -> None:
    """Chain of blocks, band and SuperLU, each from a matrix that it must not overwrite."""
    chain = BlockPattern(dofs, row, size).assemble(tangents)
    matrix = general(dofs, tangents, size)
    band = lower_band(matrix)
    print(f"{size} unknowns, half band {len(band) - 1}, blocks of {2 * row}")
    rhs = np.sin(np.arange(size))
    residual = np.abs(matrix @ BlockCholesky(copied(chain)).solve(rhs) - rhs).max()
    print(f"largest residual of the chain of blocks in that matrix: {residual:.1e}")
    for label, call in (
        ("chain of blocks", lambda: BlockCholesky(copied(chain))),
        ("banded Cholesky", lambda: cholesky_banded(band, lower=True, check_finite=False)),
        ("SuperLU, COLAMD", lambda: splu(matrix, permc_spec="COLAMD")),
        ("SuperLU, MMD_AT_PLUS_A", lambda: splu(matrix, permc_spec="MMD_AT_PLUS_A")),
    ):
        print(f"{label}: {milliseconds(call):.1f} ms")
    pardiso(matrix, rhs)


def pardiso(matrix: sparse.csc_array, rhs: Array) -> None:
    """MKL's Pardiso: its public interface, and the numerical phase alone by a private call."""
    if importlib.util.find_spec("pypardiso") is None:
        print("pypardiso is not installed: pip install pypardiso to compare")
        return
    import pypardiso

    positive_definite = 2
    solver = pypardiso.PyPardisoSolver(mtype=positive_definite)
    upper = sparse.csr_matrix(sparse.triu(matrix))
    residual = np.abs(matrix @ solver.solve(upper, rhs) - rhs).max()
    spent = milliseconds(lambda: solver.factorize(upper))
    print(f"pypardiso, factorize: {spent:.1f} ms (largest residual {residual:.1e})")
    solver.set_phase(22)
    print(
        f"pypardiso, numbers alone: {milliseconds(lambda: solver._call_pardiso(upper, rhs)):.1f} ms"
    )


def copied(chain: BlockMatrix) -> BlockMatrix:
    """Copy a matrix, which our factorisation overwrites; the others make their own copies."""
    return BlockMatrix(chain.diagonal.copy(), chain.below.copy(), chain.size)


def general(dofs: list[Index], tangents: list[Array], size: int) -> sparse.csc_array:
    """Sum element tangents into a general sparse matrix."""
    matrix = sparse.csc_array((size, size))
    for block, tangent in zip(dofs, tangents, strict=True):
        rows, columns = np.broadcast_arrays(block[:, :, None], block[:, None, :])
        kept = (rows >= 0) & (columns >= 0)
        entries = tangent[kept], (rows[kept], columns[kept])
        matrix += sparse.coo_array(entries, shape=(size, size)).tocsc()
    return matrix


def lower_band(matrix: sparse.csc_array) -> Array:
    """Lower half of a symmetric matrix in LAPACK's band storage, the diagonal first."""
    lower = sparse.tril(matrix).tocoo()
    below = lower.row - lower.col
    band = np.zeros((below.max() + 1, matrix.shape[0]))
    band[below, lower.col] = lower.data
    return band


def felupe() -> None:
    """FElupe's assembly on 120 27-node bricks, as many as the spoke has."""
    if importlib.util.find_spec("felupe") is None:
        print("FElupe is not installed: pip install felupe tensortrax to compare")
        return
    import felupe as fem

    mesh = fem.Cube(n=(5, 6, 7))
    mesh = mesh.add_midpoints_edges().add_midpoints_faces().add_midpoints_volumes()
    region = fem.RegionTriQuadraticHexahedron(mesh)
    rubber = fem.NeoHooke(mu=2.0, bulk=4000.0)
    plain = fem.FieldContainer([fem.Field(region, dim=3)])
    mixed = fem.FieldsMixed(region, n=3)
    for label, law, field in (
        ("displacements", rubber, plain),
        ("three fields", fem.ThreeFieldVariation(rubber), mixed),
    ):
        body = fem.SolidBody(law, field)

        def assemble(body: fem.SolidBody = body, field: fem.FieldContainer = field) -> None:
            body.assemble.vector(field)
            body.assemble.matrix(field)

        print(f"FElupe, {label}: {milliseconds(assemble):.1f} ms")


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--mesh", choices=sorted(SPOKE_MESHES), default="campaign")
    own_kernel(parser.parse_args().mesh)
    felupe()
