"""The load-bearing model once more, written out for ``scipy.integrate.solve_bvp``.

None of the package's mathematics is used. Lengths are in R, forces in GA, moments in GA R;
``ε = GA/EA``, ``κ² = GA R²/EI``. Each region is mapped to 0…1 and all are solved at once, with the
angles as unknown parameters.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.integrate import solve_bvp


@dataclass(frozen=True)
class Answer:
    """What both forms return: angles in radians, δ/R, F/GA, and u at θ = 0, θc, π."""

    theta_c: float
    theta_t: float
    sinking: float
    force: float
    u: np.ndarray


def _arc(y, epsilon, kappa2, spokes):
    u, v, phi, n, shear, m = y
    return np.array([shear + v - phi, epsilon * n - u, kappa2 * m, -shear, n + spokes(u), shear])


def _arc_ends(at_c, left, right, at_t, top):
    """Conditions of both arcs: continuity at θc and θt, u(θt) = 0, symmetry at the top."""
    return [*(left - at_c), *(at_t - right), at_t[0], top[1], top[2], top[4]]


def _first_mesh(first, epsilon, theta_c, theta_t, sinking, points):
    """Start from u = -δ cos θ, which is a wheel moved as a rigid body."""
    x = np.linspace(0, 1, points)
    y = np.zeros((first + 12, points))
    for row, angle in (
        (0, theta_c * x),
        (first, theta_c + (theta_t - theta_c) * x),
        (first + 6, theta_t + (np.pi - theta_t) * x),
    ):
        y[row], y[row + 1] = -sinking * np.cos(angle), sinking * np.sin(angle)
    return x, y


def linear(
    epsilon: float,
    kappa2: float,
    a_j: float,
    a_k: float,
    force: float,
    guess: tuple[float, float, float],
    tolerance: float = 1e-9,
    points: int = 21,
) -> Answer:
    """Solve the paper's linear model for a given F/GA.

    In the contact u, v, Φ, N, M are integrated; flatness gives V = Φ + tan θ (1 + ε N), and its
    derivative takes the place of the ground's pressure.
    """

    def shear_of(theta, y):
        return y[2] + np.tan(theta) * (1 + epsilon * y[3])

    def right(x, y, parameters):
        theta_c, theta_t = parameters
        theta, t = theta_c * x, np.tan(theta_c * x)
        u, v, phi, n, m = y[:5]
        shear = shear_of(theta, y)
        rate = (1 + t * t) * (1 + epsilon * n) + kappa2 * m
        dn = (-shear - t * (rate - n)) / (1 + epsilon * t * t)
        contact = np.array([shear + v - phi, epsilon * n - u, kappa2 * m, dn, shear])
        near = _arc(y[5:11], epsilon, kappa2, lambda u: a_j * u)
        far = _arc(y[11:], epsilon, kappa2, lambda u: a_k * u)
        return np.vstack([theta_c * contact, (theta_t - theta_c) * near, (np.pi - theta_t) * far])

    def conditions(ya, yb, parameters):
        theta_c = parameters[0]
        u, v, phi, n, m = yb[:5]
        shear = shear_of(theta_c, yb[:5])
        at_c = np.array([u, v, phi, n, shear, m])
        ground = shear * np.cos(theta_c) - n * np.sin(theta_c)
        sinking = -ya[0]
        misfit = 2 * ground + 2 * a_j * sinking * theta_c - force
        ends = _arc_ends(at_c, ya[5:11], yb[5:11], ya[11:], yb[11:])
        return np.array([ya[1], ya[2], *ends, misfit])

    theta_c, theta_t, sinking = guess
    x, y = _first_mesh(5, epsilon, theta_c, theta_t, sinking, points)
    solution = solve_bvp(
        right, conditions, x, y, p=np.array([theta_c, theta_t]), tol=tolerance, max_nodes=20000
    )
    if not solution.success:
        raise RuntimeError(solution.message)
    y = solution.y
    u = np.array([y[0, 0], y[0, -1], y[11, -1]])
    return Answer(*solution.p, -y[0, 0], force, u)


def with_law(
    epsilon: float,
    kappa2: float,
    spokes: Callable[[np.ndarray], np.ndarray],
    force: float,
    guess: tuple[float, float, float],
    tolerance: float = 1e-9,
    points: int = 41,
) -> Answer:
    """Solve with any smeared spoke force s(u)/GA, acting locally in the contact as well.

    In the contact the sideways displacement w, Φ, M, the horizontal resultant H and the spokes'
    vertical sum are integrated; H' = s sin θ, and W follows from flatness.
    """

    def resultants(theta, phi, h):
        s, c = np.sin(theta), np.cos(theta)
        w = (s / c + phi - (1 - epsilon) * h * s) / (c + epsilon * s * s / c)
        return w, h * c - w * s, w * c + h * s

    def right(x, y, parameters):
        theta_c, theta_t, sinking = parameters
        theta = theta_c * x
        s, c = np.sin(theta), np.cos(theta)
        sideways, phi, m, h = y[:4]
        _, n, shear = resultants(theta, phi, h)
        pull = spokes((1 - c - sinking) * c + sideways * s)
        contact = np.array([(s * s + epsilon * n) / c, kappa2 * m, shear, pull * s, pull * c])
        near = _arc(y[5:11], epsilon, kappa2, spokes)
        far = _arc(y[11:], epsilon, kappa2, spokes)
        return np.vstack([theta_c * contact, (theta_t - theta_c) * near, (np.pi - theta_t) * far])

    def conditions(ya, yb, parameters):
        theta_c, _, sinking = parameters
        s, c = np.sin(theta_c), np.cos(theta_c)
        sideways, phi, m, h, pulled = yb[:5]
        ground, n, shear = resultants(theta_c, phi, h)
        sunk = 1 - c - sinking
        at_c = np.array([sunk * c + sideways * s, sideways * c - sunk * s, phi, n, shear, m])
        ends = _arc_ends(at_c, ya[5:11], yb[5:11], ya[11:], yb[11:])
        return np.array([ya[0], ya[1], ya[4], *ends, 2 * (ground - pulled) - force])

    theta_c, theta_t, sinking = guess
    x, y = _first_mesh(5, epsilon, theta_c, theta_t, sinking, points)
    y[:5] = 0
    solution = solve_bvp(right, conditions, x, y, p=np.array(guess), tol=tolerance, max_nodes=20000)
    if not solution.success:
        raise RuntimeError(solution.message)
    theta_c, theta_t, sinking = solution.p
    u = np.array([-sinking, solution.y[5, 0], solution.y[11, -1]])
    return Answer(theta_c, theta_t, sinking, force, u)
