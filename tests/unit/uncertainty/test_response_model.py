"""Surfaces with ply and rubbers: elasticities, edges of the box, folded angles."""

from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from nptcs.config.studies.surface import GaussianProcessModel, LaminationModel, PolynomialModel
from nptcs.surface.kinds.models import FitCases, fit_surface
from nptcs.tables.laboratory.material_card import PUBLISHED_PLY
from nptcs.uncertainty.response_model import (
    RubberEffect,
    SurfaceResponse,
    continued,
    folded,
    lamination_of,
)

PUBLISHED = Path(__file__).parents[3] / "raw_data" / "published"
FACTORS = ("spacing_mm", "thickness_mm", "angle_deg")
RUBBERS = ("shear_band_c10_mpa", "spoke_c10_mpa")
LAMINATION = LaminationModel(kind="lamination", coefficients=7)


@pytest.fixture(scope="module")
def process():
    """Our finite elements of table 5's cases under a Gaussian process on the lamination form."""
    table = pd.read_csv(Path(__file__).with_name("fe_plate_stiffness.csv"), comment="#")
    cases = FitCases(
        table[list(FACTORS)].to_numpy(float),
        table["stiffness_n_per_mm"].to_numpy(float),
        FACTORS,
        (),
        PUBLISHED_PLY,
    )
    return fit_surface(GaussianProcessModel(kind="gaussian_process", mean=LAMINATION), cases)


@pytest.fixture(scope="module")
def rubber_surface():
    """Table 7 under equation 22."""
    table = pd.read_csv(PUBLISHED / "table7_rubber_doe.csv")
    terms = pd.read_csv(PUBLISHED / "table8_rubber_coefficients.csv", dtype={"term": str})["term"]
    cases = FitCases(
        table[list(RUBBERS)].to_numpy(float),
        table["stiffness_n_per_mm"].to_numpy(float),
        RUBBERS,
        list(terms),
    )
    return fit_surface(PolynomialModel(kind="polynomial"), cases)


def response(process, rubbers=None):
    return SurfaceResponse(process, 0.1, lamination_of(process), rubbers)


FIDUCIAL = np.array([[215 / 15, 1.8, 45.0]])


@pytest.mark.parametrize(("constant", "finite_elements"), [("e1_mpa", 0.090), ("g12_mpa", 0.185)])
def test_the_ply_has_the_elasticity_of_finite_elements(process, constant, finite_elements):
    """Our finite elements with a constant 5 % up, G13 with G12 (N/mm); within 15 %."""
    model = response(process)
    step = 0.05 * PUBLISHED_PLY[constant]
    change = model.value(FIDUCIAL, {constant: np.array([step])}) - model.value(FIDUCIAL, {})
    assert change[0] == pytest.approx(finite_elements, rel=0.15)


def test_without_changes_the_response_is_the_surface(process):
    points = np.array([[12.0, 1.5, 20.0], [18.0, 2.0, 70.0]])
    expected = process.predict(points)
    np.testing.assert_allclose(response(process).value(points, {}), expected, rtol=1e-12)
    assert (
        response(process).own_sd(process.x) == 0.1
    ).all()  # zero at the cases, except for the least error that the response has


def test_each_point_has_its_own_change_of_the_ply(process):
    points = np.repeat(FIDUCIAL, 3, axis=0)
    steps = np.array([-5000.0, 0.0, 5000.0])
    together = response(process).value(points, {"e1_mpa": steps})
    one_by_one = [
        response(process).value(FIDUCIAL, {"e1_mpa": np.array([step])})[0] for step in steps
    ]
    np.testing.assert_allclose(together, one_by_one, rtol=1e-9)
    assert together[1] == pytest.approx(process.predict(FIDUCIAL)[0], rel=1e-9)


def test_rubbers_change_the_response_in_proportion(process, rubber_surface):
    nominal = {"shear_band_c10_mpa": 5.0, "spoke_c10_mpa": 1.04}
    model = response(process, RubberEffect(rubber_surface, nominal))
    changed = model.value(FIDUCIAL, {"spoke_c10_mpa": np.array([0.02])})
    ratio = rubber_surface.predict(np.array([[5.0, 1.06]])) / rubber_surface.predict(
        np.array([[5.0, 1.04]])
    )
    np.testing.assert_allclose(changed, process.predict(FIDUCIAL) * ratio)
    # T-C 5 is the edge of table 7: beyond it the slope at the edge continues
    up = model.value(FIDUCIAL, {"shear_band_c10_mpa": np.array([0.1])}) - process.predict(FIDUCIAL)
    down = process.predict(FIDUCIAL) - model.value(
        FIDUCIAL, {"shear_band_c10_mpa": np.array([-0.1])}
    )
    np.testing.assert_allclose(up, down, rtol=0.05)


def test_beyond_the_edge_two_factors_go_on_along_their_slopes():
    cases = FitCases(
        np.array([[a, b] for a in (0.0, 1.0, 2.0) for b in (0.0, 1.0)]),
        np.array([3 * a + 5 * b for a in (0.0, 1.0, 2.0) for b in (0.0, 1.0)]),
        ("a", "b"),
        ["1", "a", "b"],
    )
    surface = fit_surface(PolynomialModel(kind="polynomial"), cases)
    points = np.array([[2.5, 1.2], [-0.5, -0.1], [1.0, 0.5]])
    np.testing.assert_allclose(continued(surface, points), points @ [3.0, 5.0], atol=1e-9)


def test_angles_fold_at_0_and_90_degrees():
    angles = np.array([[0.0], [-2.0], [45.0], [90.0], [93.0], [180.0]])
    np.testing.assert_allclose(
        folded(angles, ("angle_deg",))[:, 0], [0.0, 2.0, 45.0, 90.0, 87.0, 0.0]
    )
    np.testing.assert_array_equal(folded(angles, ("thickness_mm",)), angles)
