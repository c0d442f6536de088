"""A ring pinched by two forces against the textbook."""

from dataclasses import replace

import numpy as np
import pytest

from nptcs.config.solvers.ring import RingElements, RingOptions
from nptcs.config.solvers.tyre import TyreGeometry
from nptcs.ring.kernel import numpy_kernel
from nptcs.ring.tyre import ring_tyre

AXIAL, BENDING, SHEAR = 3.0e6, 4.0e8, 2.0e5


def test_pinched_ring(table):
    options = RingOptions(mesh=RingElements(elements_per_pitch=4, refinement=1))
    ring = ring_tyre(TyreGeometry(), table, 5.0, options, kernel="numpy").ring
    # axial force, bending moment and shear as a Timoshenko ring; the faces and the tread carry
    # nothing and turn with the line
    stiffness = np.diag([AXIAL, BENDING, 1e2, 1e2, 1e9, SHEAR, 1e2])
    ring = replace(ring, stiffness=stiffness, hardening=np.zeros((4, 4, 4)))
    ring = replace(ring, core=np.zeros(6), feet=ring.feet[:0])
    count = len(ring.theta)
    rest = np.zeros((count, 5))
    system = numpy_kernel.assemble(ring, rest, -50.0, np.zeros(count))
    # weak springs hold the rigid motions
    diagonal = system.diagonal + 1e-3 * np.eye(5)
    force = np.zeros((count, 5, 1))
    bottom, top = (np.argmin(np.abs(ring.theta + turn)) for turn in (0.0, np.pi))
    force[bottom, 1, 0], force[top, 1, 0] = 1.0, -1.0
    u = numpy_kernel.solve(diagonal, system.upper, system.lower, force)[:, :, 0]
    radius = 307.0
    # Timoshenko, Strength of Materials II: bending, shear and the axial force
    expected = radius**3 / BENDING * (np.pi / 4 - 2 / np.pi)
    expected += np.pi * radius / 4 * (1 / SHEAR + 1 / AXIAL)
    # the curved bar couples stretch and bending: of the order of I/(A R²)
    coupling = BENDING / AXIAL / radius**2
    assert u[bottom, 1] - u[top, 1] == pytest.approx(expected, rel=0.005 + coupling)
