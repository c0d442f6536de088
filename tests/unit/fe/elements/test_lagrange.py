import numpy as np
import pytest

from nptcs.fe.elements.lagrange import gauss, jacobians, line_shape, tensor_shape


@pytest.mark.parametrize("order", [1, 2, 3])
def test_lines_interpolate_polynomials_of_their_order_and_their_slopes(order):
    points = np.linspace(-1.4, 1.4, 9)
    nodes = np.linspace(-1.0, 1.0, order + 1)
    value, slope = line_shape(order, points)
    assert value @ nodes**order == pytest.approx(points**order)
    assert slope @ nodes**order == pytest.approx(order * points ** (order - 1))


def test_gauss_integrates_a_product_of_powers():
    points, weights = gauss((2, 3))
    assert np.sum(weights * points[:, 0] ** 2 * points[:, 1] ** 4) == pytest.approx(2 / 3 * 2 / 5)


def test_gradients_of_a_skewed_element_reproduce_a_linear_field():
    local = np.array(np.meshgrid([-1, 0, 1], [-1, 0, 1], [-1, 1], indexing="ij")).reshape(3, -1).T
    skew = np.array([[2.0, 0.3, 0.1], [0.0, 1.5, 0.4], [0.2, 0.0, 1.1]])
    corners = local @ skew.T
    points, weights = gauss((2, 2, 2))
    _, slope = tensor_shape((2, 2, 1), points)
    gradient, volume = jacobians(slope, corners[None])
    wanted = np.array([0.7, -1.2, 0.4])
    found = np.einsum("egni,n->egi", gradient, corners @ wanted)
    assert found == pytest.approx(np.broadcast_to(wanted, found.shape))
    assert np.sum(volume * weights) == pytest.approx(8.0 * np.linalg.det(skew))


def test_an_inverted_element_is_refused():
    corners = np.array([[[0.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [-1.0, 1.0]]])
    _, slope = tensor_shape((1, 1), np.zeros((1, 2)))
    with pytest.raises(ValueError, match="element 0 is inverted"):
        jacobians(slope, corners)
