"""The kernels that the parent process of all cases compiles are all that a case needs."""

import subprocess
import sys

CASE = """
from nptcs.config.solvers.fe import FeModel
from nptcs.config.solvers.tyre import TyreGeometry
from nptcs.fe.case import spoke_design
from nptcs.fe.elements import compiled, preloaded
from nptcs.fe.matrices.compiled import add_at
from nptcs.fe.spoke.equilibrium import SpokeModel
from nptcs.fe.tyre.element_groups import ring_rubbers, wire_groups
from nptcs.fe.tyre.mesh import build_ring
from nptcs.tables.laboratory.material_card import PUBLISHED_PLY
import numpy as np

kernels = [compiled.rubber, compiled.linear, compiled.added_strain, add_at]
assert [len(kernel.signatures) for kernel in kernels] == [1, 1, 1, 1]
names = ("spacing_mm", "thickness_mm", "angle_deg", "spoke_c10_mpa")
values = dict(zip(names, (20.0, 1.8, 45.0, 1.0), strict=True))
model, tyre = FeModel(), TyreGeometry()
spoke = SpokeModel(spoke_design(model, tyre, PUBLISHED_PLY, values))
spoke.move(spoke.rest(), np.array([-0.5, 0.0, 0.0]))
ring = build_ring(tyre, model.tyre_mesh, model.geometry.foot_width_mm())
for group in [*ring_rubbers(ring, 215.0, 5.0, 10.0), *wire_groups(ring, tyre)]:
    group.respond(np.zeros_like(ring.positions))
    group.follow(np.zeros_like(ring.positions))
print([len(kernel.signatures) for kernel in kernels])
"""


def test_a_case_compiles_nothing_more():
    found = subprocess.run(
        [sys.executable, "-c", CASE], capture_output=True, text=True, check=False, timeout=300
    )
    assert found.returncode == 0, found.stderr
    assert found.stdout.strip() == "[1, 1, 1, 1]"
