import numpy as np
import pytest

from nptcs.config.tyre import TyreGeometry
from nptcs.fe import calibration
from nptcs.fe.calibration import (
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
    slopes = rng.normal(size=(9, len(FREE)))
    away = 0.005 * rng.normal(size=len(FREE))
    wanted = np.log([[30.0, 13.0], [31.0, 14.0]])
    spokes = wanted - (slopes[:4] @ away).reshape(2, 2)
    tyres = np.log([200.0 + 20.0 * i for i in range(5)]) - slopes[4:] @ away
    start = np.log([getattr(START.geometry, name) for name in FREE])
    misfit = calibration._misfit(case, spokes, tyres, np.zeros(len(FREE)))
    step = calibration._step(case, slopes, misfit, start, case.damping)
    assert step == pytest.approx(away, abs=1e-6)


def test_the_section_is_replaced_and_the_rest_kept():
    free = np.log([getattr(START.geometry, name) for name in FREE])
    model = problem().with_section(free + 0.01)
    assert model.geometry.leg_angle_deg == pytest.approx(29.64 * np.exp(0.01))
    assert model.geometry.height_mm == START.geometry.height_mm
    assert model.spoke_mesh == START.spoke_mesh


def test_no_dimension_leaves_its_limits():
    case = problem()
    here = np.log([getattr(START.geometry, name) for name in FREE])
    slopes = np.zeros((9, len(FREE)))
    slopes[:, FREE.index("foot_thickness_mm")] = 0.01
    spokes = np.log([[30.0, 13.0], [31.0, 14.0]]) - 0.1
    tyres = np.log([200.0 + 20.0 * i for i in range(5)])
    misfit = calibration._misfit(case, spokes, tyres, np.zeros(len(FREE)))
    step = calibration._step(case, slopes, misfit, here, 1e-9)
    reached = np.exp(here + step)[FREE.index("foot_thickness_mm")]
    assert reached == pytest.approx(LIMITS["foot_thickness_mm"][1], rel=1e-4)


def test_a_step_is_halved_where_a_tyre_fails():
    case = problem()
    here = np.zeros(len(FREE))

    def mapper(job, jobs):
        if any(free[0] > 0.03 for free, _ in jobs):
            raise TyreError("no equilibrium", LoadPath())
        return [5.0 if job.func is calibration._tyre_job else [1.0, 2.0] for _ in jobs]

    step = np.full(len(FREE), 0.1)
    moved, spokes, tyres = calibration._reach(case, here, step, mapper)
    assert moved == pytest.approx(0.25 * step)
    assert tyres == pytest.approx([5.0] * 5)
    assert spokes == pytest.approx(np.array([[1.0, 2.0]] * 2))
    with pytest.raises(TyreError, match="no equilibrium"):
        calibration._reach(case, here, 100.0 * step, mapper)


def test_rounds_walk_to_a_manufactured_section(monkeypatch):
    """The whole loop on a law that is a power of the dimensions."""
    rng = np.random.default_rng(4)
    start = np.log([getattr(START.geometry, name) for name in FREE])
    goal = start + 0.2 * np.array([0.02, 0.03, -0.04, 0.02, 0.05, 0.01, -0.03, 0.02, -0.02])
    powers = rng.normal(size=(9, len(FREE)))
    case = problem()

    def stiffness(problem_, points, sections, mapper):
        away = np.array(sections) - goal
        spokes = np.log([[30.0, 13.0], [31.0, 14.0]]) + (away @ powers[:4].T).reshape(-1, 2, 2)
        tyres = np.log([200.0 + 20.0 * i for i in range(5)]) + away @ powers[4:].T
        # the coarse model, asked for several sections at once, is a little wrong
        return spokes, tyres * (1.01 if len(sections) > 1 else 1.0)

    class Pool:
        def __init__(self, workers):
            self.map = map

        def __enter__(self):
            return self

        def __exit__(self, *error):
            return None

    monkeypatch.setattr(calibration, "_stiffness", stiffness)
    monkeypatch.setattr(calibration, "ProcessPoolExecutor", Pool)
    seen = []
    model = calibrate(case, 6, 1, seen.append)
    found = np.log([getattr(model.geometry, name) for name in FREE])
    assert len(seen) == 7
    assert found == pytest.approx(goal, abs=2e-3)
