"""Assembly and factorisation of the spoke, side by side with SuperLU and, if installed, FElupe.

    python benchmarks/fe_kernel.py

Processor time of one call, the mean of ten; see ``docs/decisions/0003-fe-kernel.md``.
"""

from __future__ import annotations

import importlib.util
import time
from collections.abc import Callable

import numpy as np
import scipy.sparse as sparse
from scipy.sparse.linalg import splu

from nptcs.config.fe import SpokeGeometry, SpokeMesh
from nptcs.fe.calibration import PUBLISHED_PLY
from nptcs.fe.matrices import BandedCholesky, BandedPattern, element_dofs
from nptcs.fe.spoke import SpokeDesign, SpokeModel

REPEATS = 10


def milliseconds(call: Callable[[], object]) -> float:
    """Processor time of one call, after one to warm up."""
    call()
    start = time.process_time()
    for _ in range(REPEATS):
        call()
    return 1000.0 * (time.process_time() - start) / REPEATS


def own_kernel() -> None:
    """Assembly of the package, and its band against SuperLU on the same matrix."""
    design = SpokeDesign(
        SpokeGeometry(), SpokeMesh(), 215.0 / 15, 5.0, 1.8, 45.0, 1.0, PUBLISHED_PLY, 15
    )
    model = SpokeModel(design)
    rest = np.zeros_like(model.mesh.positions)
    bricks = model.rubbers[0]
    spent = milliseconds(lambda: bricks.respond(rest))
    print(f"{len(bricks.nodes)} bricks, own blocks: {spent:.1f} ms")
    blocks = model.blocks
    print(f"whole spoke: {milliseconds(lambda: [b.respond(rest) for b in blocks]):.1f} ms")
    row = 3 * model.mesh.nodes_per_row
    size = rest.size - 2 * row
    number = np.arange(rest.size) - row
    number[(number < 0) | (number >= size)] = -1
    pattern = BandedPattern([number[element_dofs(b.nodes, 3)] for b in blocks], size, True)
    band = pattern.assemble([b.respond(rest).tangent for b in blocks])
    print(f"{size} unknowns, half band {pattern.width}")
    print(f"banded Cholesky: {milliseconds(lambda: BandedCholesky(band)):.1f} ms")
    lower = sparse.diags(
        [band[i, : size - i] for i in range(len(band))], [-i for i in range(len(band))]
    ).tocsc()
    matrix = (lower + sparse.tril(lower, -1).T).tocsc()
    matrix.eliminate_zeros()
    for order in ("COLAMD", "MMD_AT_PLUS_A"):
        spent = milliseconds(lambda order=order: splu(matrix, permc_spec=order))
        print(f"SuperLU, {order}: {spent:.1f} ms")


def felupe() -> None:
    """FElupe's assembly on as many 27-node bricks."""
    if importlib.util.find_spec("felupe") is None:
        print("FElupe is not installed: pip install felupe tensortrax to compare")
        return
    import felupe as fem

    mesh = fem.Cube(n=(5, 5, 5))
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
    own_kernel()
    felupe()
