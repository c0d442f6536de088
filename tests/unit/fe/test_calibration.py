import numpy as np
import pytest

from nptcs.config.solvers.fe import FeModel
from nptcs.config.solvers.tyre import TyreGeometry
from nptcs.fe import calibration
from nptcs.fe.calibration import (
    FREE,
    LIMITS,
    START,
    TYRE_EXPONENTS,
    CalibrationProblem,
    SpokeTarget,
    TyreTarget,
    calibrate,
)
from nptcs.fe.tyre.equilibrium import LoadPath, TyreError
from nptcs.tables.laboratory.material_card import PUBLISHED_PLY

VALUES = {"thickness_mm": 1.8}
# inside the limits of all dimensions
INSIDE = FeModel().model_copy(
    update={
        "geometry": START.model_copy(
            update={
                "leg_thickness_mm": 3.0,
                "block_half_length_mm": 6.5,
                "foot_thickness_mm": 13.5,
                "plate_foot_gap_mm": 4.0,
                "plate_mid_gap_mm": 4.5,
            }
        )
    }
)


def problem():
    spokes = tuple(SpokeTarget(VALUES | {"place": i}, 30.0 + i, 13.0 + i) for i in range(2))
    tyres = tuple(TyreTarget(VALUES | {"place": 2 + i}, 200.0 + 20.0 * i) for i in range(5))
    return CalibrationProblem(
        INSIDE, TyreGeometry(), PUBLISHED_PLY, spokes, tyres, 5000.0, prior=1e-6, damping=1e-6
    )


TARGETS = np.log([30.0, 13.0, 31.0, 14.0, *[200.0 + 20.0 * i for i in range(5)]])
SECTION = np.log([getattr(INSIDE.geometry, name) for name in FREE])


def test_a_linear_problem_is_solved_in_one_step():
    """Manufactured: ln k linear in ln (dimension), the targets reached at a known section."""
    rng = np.random.default_rng(2)
    case = problem()
    slopes = rng.normal(size=(9, len(FREE)))
    away = 0.01 * rng.normal(size=len(FREE))
    misfit = calibration._misfit(case, TARGETS - slopes @ away, np.zeros(len(FREE)))
    step = calibration._step(case, slopes, misfit, SECTION, case.damping)
    assert step == pytest.approx(away, abs=1e-6)


def test_the_section_is_replaced_and_the_rest_kept():
    model = problem().with_section(SECTION + 0.01)
    assert model.geometry.leg_angle_deg == pytest.approx(
        INSIDE.geometry.leg_angle_deg * np.exp(0.01)
    )
    assert model.geometry.height_mm == INSIDE.geometry.height_mm
    assert model.spoke_mesh == INSIDE.spoke_mesh


def test_no_dimension_leaves_its_limits():
    case = problem()
    slopes = np.zeros((9, len(FREE)))
    slopes[:, FREE.index("foot_thickness_mm")] = 0.01
    misfit = calibration._misfit(case, TARGETS - 0.1, np.zeros(len(FREE)))
    step = calibration._step(case, slopes, misfit, SECTION, 1e-9)
    reached = np.exp(SECTION + step)[FREE.index("foot_thickness_mm")]
    assert reached == pytest.approx(LIMITS["foot_thickness_mm"][1], rel=1e-4)


def test_a_step_is_halved_where_a_tyre_fails():
    case = problem()

    def mapper(job, jobs):
        if any(free[0] > 0.03 for free, _ in jobs):
            raise TyreError("no equilibrium", LoadPath())
        return [[5.0] if isinstance(target, TyreTarget) else [3.0, 2.0] for _, target in jobs]

    here = np.zeros(len(FREE))
    moved, computed = calibration._reach(case, here, np.full(len(FREE), 0.1), mapper)
    assert moved == pytest.approx(np.full(len(FREE), 0.025))
    assert computed == pytest.approx([3.0, 2.0, 3.0, 2.0, *[5.0] * 5])
    with pytest.raises(TyreError, match="no equilibrium"):
        calibration._reach(case, here, np.full(len(FREE), 10.0), mapper)


def test_rounds_walk_to_a_manufactured_section(monkeypatch):
    """The whole loop on a law that is a power of the dimensions, and bends a little."""
    rng = np.random.default_rng(4)
    goal = SECTION + 0.4 * np.array([0.02, 0.03, -0.04, 0.02, 0.05, 0.01, -0.03, 0.04, -0.02])
    # of the spokes of all targets; a tyre's stiffness is a product of powers of its spoke's two
    powers, bend = rng.normal(size=(2, 7, 2, len(FREE)))
    case = problem()

    def moved(values, free):
        place = int(values["place"])
        return powers[place] @ (free - goal) + bend[place] @ (free - goal) ** 2

    def spoke(problem_, job):
        free, values = job
        return list(moved(values, free))

    def computed(problem_, job):
        free, target = job
        place = int(target.values["place"])
        if place < 2:
            return list(TARGETS[2 * place : 2 * place + 2] + moved(target.values, free))
        return [TARGETS[2 + place] + TYRE_EXPONENTS @ moved(target.values, free)]

    class Pool:
        def __init__(self, workers):
            self.map = map

        def __enter__(self):
            return self

        def __exit__(self, *error):
            return None

    monkeypatch.setattr(calibration, "_job", computed)
    monkeypatch.setattr(calibration, "_spoke_job", spoke)
    monkeypatch.setattr(calibration, "ProcessPoolExecutor", Pool)
    seen = []
    model = calibrate(case, 6, 1, seen.append)
    found = np.log([getattr(model.geometry, name) for name in FREE])
    assert len(seen) == 7
    assert found == pytest.approx(goal, abs=2e-3)
    assert seen[-1].spoke_stiffness == pytest.approx(np.array([[30, 13], [31, 14]]), rel=1e-3)
    assert seen[-1].tyre_stiffness == pytest.approx(200.0 + 20.0 * np.arange(5), rel=1e-3)


def test_a_round_that_was_worse_corrects_the_slopes():
    rng = np.random.default_rng(5)
    slopes, step, change = rng.normal(size=(9, 4)), rng.normal(size=4), rng.normal(size=9)
    corrected = calibration._corrected(slopes, step, change)
    assert corrected @ step == pytest.approx(change)
    across = np.linalg.svd(step[None])[2][1:]
    assert corrected @ across.T == pytest.approx(slopes @ across.T)
