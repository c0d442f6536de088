import dataclasses

import numpy as np
import pytest

from nptcs.config.tyre import TyreGeometry
from nptcs.fe import calibration
from nptcs.fe.calibration import (
    EXPONENT,
    FREE,
    LIMITS,
    PUBLISHED_PLY,
    START,
    Problem,
    SpokeTarget,
    TyreTarget,
    calibrate,
)
from nptcs.fe.tyre import LoadPath, TyreError

VALUES = {"thickness_mm": 1.8}


def problem():
    spokes = tuple(SpokeTarget(VALUES, 30.0 + i, 13.0 + i) for i in range(2))
    tyres = tuple(TyreTarget(VALUES | {"case": i}, 200.0 + 20.0 * i) for i in range(5))
    return Problem(
        START, TyreGeometry(), PUBLISHED_PLY, spokes, tyres, 5000.0, prior=1e-6, damping=1e-6
    )


def test_a_linear_problem_is_solved_in_one_step():
    """Manufactured: ln k linear in ln (dimension), the targets reached at a known section."""
    rng = np.random.default_rng(2)
    case = problem()
    slopes = rng.normal(size=(7, 2, len(FREE)))
    away = 0.01 * rng.normal(size=len(FREE))
    wanted = np.log([[30.0, 13.0], [31.0, 14.0]])
    spokes = np.concatenate([wanted, np.zeros((5, 2))]) - slopes @ away
    targets = np.log([200.0 + 20.0 * i for i in range(5)])
    tyres = targets - EXPONENT * (slopes[2:] @ away).mean(axis=1)
    start = np.log([getattr(START.geometry, name) for name in FREE])
    step = calibration._step(case, slopes, spokes, tyres, start, start)
    assert step == pytest.approx(away, abs=1e-6)


def test_the_section_is_replaced_and_the_rest_kept():
    free = np.log([getattr(START.geometry, name) for name in FREE])
    model = problem().with_section(free + 0.01)
    assert model.geometry.leg_angle_deg == pytest.approx(30.4 * np.exp(0.01))
    assert model.geometry.height_mm == START.geometry.height_mm
    assert model.spoke_mesh == START.spoke_mesh


def test_no_dimension_leaves_its_limits():
    case = dataclasses.replace(problem(), damping=1e-9)
    here = np.log([getattr(START.geometry, name) for name in FREE])
    slopes = np.zeros((7, 2, len(FREE)))
    slopes[:, :, FREE.index("foot_thickness_mm")] = 0.01
    spokes = np.log([[30.0, 13.0], [31.0, 14.0], *[[1.0, 1.0]] * 5]) - 0.1
    tyres = np.log([200.0 + 20.0 * i for i in range(5)])
    step = calibration._step(case, slopes, spokes, tyres, here, here)
    reached = np.exp(here + step)[FREE.index("foot_thickness_mm")]
    assert reached == pytest.approx(LIMITS["foot_thickness_mm"][1], rel=1e-4)


def test_a_step_is_halved_where_a_tyre_fails():
    case = problem()
    here = np.zeros(len(FREE))

    def mapper(job, jobs):
        if any(free[0] > 0.03 for free, _ in jobs):
            raise TyreError("no equilibrium", LoadPath())
        return [5.0 for _ in jobs]

    moved, stiffness = calibration._reach(case, here, np.full(len(FREE), 0.1), mapper)
    assert moved == pytest.approx(np.full(len(FREE), 0.025))
    assert stiffness == pytest.approx([5.0] * 5)
    with pytest.raises(TyreError, match="no equilibrium"):
        calibration._reach(case, here, np.full(len(FREE), 10.0), mapper)


def test_rounds_walk_to_a_manufactured_section(monkeypatch):
    """The whole loop on a law that is a power of the dimensions."""
    rng = np.random.default_rng(4)
    start = np.log([getattr(START.geometry, name) for name in FREE])
    goal = start + 0.4 * np.array([0.02, 0.03, -0.04, 0.02, 0.05, 0.01, -0.03, 0.04, -0.02])
    powers = rng.normal(size=(7, 2, len(FREE)))
    case = problem()
    wanted = np.zeros((7, 2))
    wanted[:2] = np.log([[30.0, 13.0], [31.0, 14.0]])

    def spokes(problem_, steps, points, mapper):
        return np.array([wanted + powers @ (point - goal) for point in points])

    def tyre(problem_, job):
        free, values = job
        i = int(values["case"])
        target = np.log(200.0 + 20.0 * i)
        return target + 1.2 * EXPONENT * (powers[2 + i] @ (free - goal)).mean()

    class Pool:
        def __init__(self, workers):
            self.map = map

        def __enter__(self):
            return self

        def __exit__(self, *error):
            return None

    monkeypatch.setattr(calibration, "_spokes", spokes)
    monkeypatch.setattr(calibration, "_tyre_job", tyre)
    monkeypatch.setattr(calibration, "ProcessPoolExecutor", Pool)
    seen = []
    model = calibrate(case, 6, 1, seen.append)
    found = np.log([getattr(model.geometry, name) for name in FREE])
    assert len(seen) == 7
    assert found == pytest.approx(goal, abs=2e-3)
