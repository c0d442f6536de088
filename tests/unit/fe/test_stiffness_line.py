"""Lines through the origin, checked by hand."""

import numpy as np
import pytest

from nptcs.fe.spoke.stiffness_line import stiffness_line


def test_regression_through_the_origin_and_both_r_squares():
    displacement = np.array([0.0, 1.0, 2.0, 3.0])
    fit = stiffness_line(displacement, 4.0 * displacement)
    assert (fit.slope, fit.r2_uncentred, fit.r2_centred) == pytest.approx((4.0, 1.0, 1.0))
    bent = stiffness_line(displacement, np.array([0.0, 4.0, 7.0, 9.0]))
    assert bent.slope == pytest.approx((4.0 + 14.0 + 27.0) / 14.0)
    assert bent.r2_centred < bent.r2_uncentred < 1.0


def test_slope_and_r_squares_by_hand():
    line = stiffness_line(np.array([0.0, 2.0, 4.0]), np.array([0.0, 60.0, 140.0]))
    # k = Σfd/Σd² = (60·2 + 140·4)/(4 + 16); SSE = 8² + 4²; Σf² = 23200
    assert line.slope == pytest.approx(34.0)
    assert line.r2_uncentred == pytest.approx(1 - 80 / 23200)
    assert line.r2_centred == pytest.approx(1 - 80 / (23200 - 200**2 / 3))
