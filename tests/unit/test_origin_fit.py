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
