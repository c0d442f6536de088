"""A ring on any spokes, pressed flat between given edges.

Spokes follow a law. Smeared over the arc they make a symmetric wheel, of which one half is solved;
single spokes act at their angles on a whole ring. In the contact region they are either taken at
their local displacement and pull on the ring as they do elsewhere (``local``), or, as in the
paper, all shortened by δ and carried past the ring to the ground (``paper``, equation 14).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np
from scipy.interpolate import CubicHermiteSpline
from scipy.sparse import coo_array
from scipy.sparse.linalg import spsolve

from nptcs.arrays import Floating, Mask
from nptcs.lca.any_spokes.collocation import (
    Elements,
    condense,
    contact_system,
    free_matrix,
    gauss_tableau,
)
from nptcs.lca.section import ShearBandSection
from nptcs.lca.spokes.law import SpokeLaw

ContactSpokes = Literal["paper", "local"]
_WIDEST, _MOST = 0.08, 600
"""Widest element (radians) and most elements on half a wheel."""
_FEW_POINTS = 50
"""Most inner points of a curve at which the elements are aligned with each of them."""
SAME_ANGLE = 1e-9
"""Angles (radians) closer than this are taken as equal."""


@dataclass(frozen=True)
class Wheel:
    """A wheel in the units of `nptcs.lca.linear.scaling`.

    Parameters
    ----------
    section, law : ShearBandSection, SpokeLaw
        Ring and spokes.
    contact : {"local", "paper"}
        How the contact region's spokes act; single spokes act locally.
    spoke_angles : array, optional
        Angles of all single spokes (radians), on a ring that starts in the middle between two
        of them; if not given, the spokes are smeared.
    """

    section: ShearBandSection
    law: SpokeLaw
    contact: ContactSpokes = "local"
    spoke_angles: Floating | None = None

    @property
    def epsilon(self) -> float:
        """GA/EA."""
        return self.section.shear_stiffness_n / self.section.axial_stiffness_n

    @property
    def kappa2(self) -> float:
        """GA R²/EI."""
        section = self.section
        return section.shear_stiffness_n * section.radius_mm**2 / section.bending_stiffness_n_mm2

    @property
    def passes_by(self) -> bool:
        """Whether the contact region's spokes bypass the ring, as in the paper."""
        return self.contact == "paper" and self.spoke_angles is None

    @property
    def span(self) -> tuple[float, float]:
        """First and last angle (radians): half a wheel, or a whole ring cut between spokes."""
        if self.spoke_angles is None:
            return 0.0, float(np.pi)
        start = float(self.spoke_angles.min() - np.pi / self.law.count)
        return start, start + 2 * float(np.pi)

    def force(self, u: Floating) -> tuple[Floating, Floating]:
        """Force of the spokes over GA and its slope with u_r/R; per radian if smeared."""
        force, slope = self.law.evaluate(u * self.section.radius_mm)
        factor = 1 / self.section.shear_stiffness_n
        if self.spoke_angles is None:
            factor *= self.law.count / (2 * np.pi)
        return force * factor, slope * factor * self.section.radius_mm


@dataclass(frozen=True)
class Edge:
    """One end of the contact.

    Parameters
    ----------
    angle : float
        θ in radians.
    share : float
        Share of the force of a single spoke exactly at the edge that the ground takes
        directly; a point reaction holds the edge there while it grows from 0 to 1.
    """

    angle: float
    share: float = 0.0


@dataclass(frozen=True)
class Pressed:
    """The wheel pressed flat between its edges; states as `nptcs.lca.linear.arc.STATE`.

    Parameters
    ----------
    left, right : Edge
        Ends of the contact; the left one is the line of symmetry if the spokes are smeared.
    points : array, shape (n + 1,)
        Ends of the elements (radians).
    theta : array, shape (n, stages)
        Stages.
    in_contact : bool array, shape (n,)
        Which elements lie on the ground.
    states : array, shape (n, stages + 2, 6)
        State at the start, the stages and the end of each element.
    pressure : array, shape (n, stages)
        b R q/GA at the stages.
    sinking, force : float
        δ/R and the ground's force F/GA on the whole wheel.
    contact_force : float
        Vertical force of the contact region's spokes, over GA.
    balance_residual : float
        (F - vertical sum of all spoke forces)/F.
    hub_moment : float
        Moment about the hub, over GA R, that the ground leaves unbalanced on a whole ring.
    """

    left: Edge
    right: Edge
    points: Floating
    theta: Floating
    in_contact: Mask
    states: Floating
    pressure: Floating
    sinking: float
    force: float
    contact_force: float
    balance_residual: float
    hub_moment: float

    def field(self) -> CubicHermiteSpline:
        """u_r/R as a function of θ, for the next mesh and linearisation."""
        y = np.concatenate([self.states[:, 0], self.states[-1:, -1]])
        return CubicHermiteSpline(self.points, y[:, 0], y[:, 4] + y[:, 1] - y[:, 2])


def break_points(
    wheel: Wheel, left: Edge, right: Edge, field: CubicHermiteSpline | None
) -> Floating:
    """Return the elements' ends: wherever the equations change, and as many between as needed."""
    start, end = wheel.span
    fixed = [np.array([start, left.angle, right.angle, end])]
    if wheel.spoke_angles is not None:
        fixed.append(wheel.spoke_angles)
    elif field is not None:
        inner = wheel.law.elongation_mm[1:-1]
        # between the many points of a measured curve the curvature hardly jumps
        knots = (inner if len(inner) <= _FEW_POINTS else np.zeros(1)) / wheel.section.radius_mm
        fixed += [field.solve(knot, extrapolate=False) for knot in knots]
    points = np.unique(np.concatenate(fixed))
    points = points[np.append(True, np.diff(points) > SAME_ANGLE)]
    for exact in (end, left.angle, right.angle):
        points[np.argmin(np.abs(points - exact))] = exact
    stiffest = wheel.kappa2
    if wheel.spoke_angles is None:
        _, slope = wheel.force(wheel.law.elongation_mm / wheel.section.radius_mm)
        stiffest += slope.max()
    widest = max(min(_WIDEST, 1.5 / np.sqrt(stiffest)), np.pi / _MOST)
    pieces = np.ceil(np.diff(points) / widest).astype(int)
    parts = [
        np.linspace(a, b, n, endpoint=False)
        for a, b, n in zip(points[:-1], points[1:], pieces, strict=True)
    ]
    return np.append(np.concatenate(parts), end)


def press_wheel(
    wheel: Wheel, left: Edge, right: Edge, field: CubicHermiteSpline | None = None
) -> Pressed:
    """Solve the wheel for given edges, the spokes linearised about a displacement `field`.

    Without a field the law is linearised at a displacement of a thousandth of the radius.
    """
    points = break_points(wheel, left, right, field)
    starts, widths = points[:-1], np.diff(points)
    theta = starts[:, None] + widths[:, None] * gauss_tableau().nodes
    in_contact = (starts > left.angle - SAME_ANGLE) & (starts < right.angle - SAME_ANGLE)
    slope, offset = _smeared_spokes(wheel, theta, in_contact, field)
    matrix, vector = free_matrix(theta, slope, wheel.epsilon, wheel.kappa2), _only_v(offset)
    matrix[in_contact], vector[in_contact] = contact_system(
        theta[in_contact], slope[in_contact], offset[in_contact], wheel.epsilon, wheel.kappa2
    )
    elements = condense(widths, matrix, vector)
    jumps = _single_spokes(wheel, left, right, points, field)
    first_contact = int(np.flatnonzero(in_contact)[0])
    before, after, sinking = solve_ends(
        elements, jumps, _end_conditions(wheel, points, first_contact)
    )
    stages = np.einsum("nsij,nj->nsi", elements.stage_map, after) + elements.stage_vector
    states = np.concatenate([after[:, None], stages, before[1:, None]], axis=1)
    spokes = slope * stages[..., 0] + offset
    v_rate = np.einsum("nsj,nsj->ns", matrix[..., 4, :], stages) + vector[..., 4]
    excess = (v_rate - stages[..., 3] - spokes) / np.cos(theta)
    pressure = np.where(in_contact[:, None], excess, 0.0)
    single = jumps.slope * before[:, 0] + jumps.offset
    force, contact_force, residual = _vertical_forces(
        wheel,
        (left, right),
        points,
        in_contact,
        pressure,
        spokes,
        jumps.ground,
        single,
        sinking,
    )
    hub_moment = float(before[-1, 5] - before[0, 5]) if wheel.spoke_angles is not None else 0.0
    return Pressed(
        left,
        right,
        points,
        theta,
        in_contact,
        states,
        pressure,
        sinking,
        force,
        contact_force,
        residual,
        hub_moment,
    )


def _vertical_forces(
    wheel: Wheel,
    edges: tuple[Edge, Edge],
    points: Floating,
    in_contact: Mask,
    pressure: Floating,
    spokes: Floating,
    reaction: Floating,
    single: Floating,
    sinking: float,
) -> tuple[float, float, float]:
    """Force of the ground, that of the contact region's spokes, and the misfit of the balance."""
    widths = np.diff(points)
    theta = points[:-1, None] + widths[:, None] * gauss_tableau().nodes
    weights = widths[:, None] * gauss_tableau().weights
    halves = 2.0 if wheel.spoke_angles is None else 1.0
    along = -halves * np.sum(weights * spokes * np.cos(theta), axis=1)
    pointed = -single * np.cos(points)
    within = (points > edges[0].angle - SAME_ANGLE) & (points < edges[1].angle + SAME_ANGLE)
    ground = halves * np.sum(weights * pressure) + np.sum(reaction * single)
    contact_force = along[in_contact].sum() + pointed[within].sum()
    total = along.sum() + pointed.sum()
    if wheel.passes_by:
        width = edges[1].angle - edges[0].angle
        contact_force = -halves * float(wheel.force(np.array(-sinking))[0]) * width
        ground, total = ground + contact_force, total + contact_force
    return float(ground), float(contact_force), float((ground - total) / ground)


def _only_v(offset: Floating) -> Floating:
    """Vector of a free arc: the spokes' constant part acts on V'."""
    vector = np.zeros((*offset.shape, 6))
    vector[..., 4] = offset
    return vector


def _linearised(
    wheel: Wheel, theta: Floating, field: CubicHermiteSpline | None
) -> tuple[Floating, Floating]:
    """Slope and offset of the spokes' force about the displacement field."""
    u = -1e-3 * np.cos(theta) if field is None else field(theta)
    force, slope = wheel.force(u)
    return slope, force - slope * u


def _smeared_spokes(
    wheel: Wheel, theta: Floating, in_contact: Mask, field: CubicHermiteSpline | None
) -> tuple[Floating, Floating]:
    """Slope and offset of the smeared spokes' load on the ring at the stages."""
    if wheel.spoke_angles is not None:
        return np.zeros_like(theta), np.zeros_like(theta)
    slope, offset = _linearised(wheel, theta, field)
    if wheel.passes_by:
        slope[in_contact], offset[in_contact] = 0.0, 0.0
    return slope, offset


@dataclass(frozen=True)
class Jumps:
    """Single spokes at the element ends; arrays over the n + 1 ends.

    The spoke's force is slope u + offset; V and N jump by `shear` and `axial` times it, the
    ground takes `ground` times it directly.
    """

    slope: Floating
    offset: Floating
    shear: Floating
    axial: Floating
    ground: Floating


def _single_spokes(
    wheel: Wheel, left: Edge, right: Edge, points: Floating, field: CubicHermiteSpline | None
) -> Jumps:
    """Single spokes at the element ends, none if the spokes are smeared.

    On the ground flatness requires ΔV = ε tan θ ΔN: the reaction is -S/(cos θ + ε sin² θ/cos θ).
    """
    if wheel.spoke_angles is None:
        empty = np.zeros_like(points)
        return Jumps(empty, empty, empty, empty, empty)
    here = np.abs(points[:, None] - wheel.spoke_angles).min(axis=1) < SAME_ANGLE
    slope, offset = _linearised(wheel, points, field)
    share = np.where((points > left.angle) & (points < right.angle), 1.0, 0.0)
    for edge in (left, right):
        share[np.abs(points - edge.angle) < SAME_ANGLE] = edge.share
    sine, cosine = np.sin(points), np.cos(points)
    ground = np.zeros_like(points)
    reached = share > 0
    ground[reached] = -share[reached] / (cosine + wheel.epsilon * sine**2 / cosine)[reached]
    return Jumps(
        np.where(here, slope, 0.0),
        np.where(here, offset, 0.0),
        1 + ground * cosine,
        -ground * sine,
        ground,
    )


def _end_conditions(
    wheel: Wheel, points: Floating, first: int
) -> tuple[list[tuple[int, int, float]], list[float]]:
    """Seven conditions on top of the elements': (condition, unknown, factor), right-hand sides.

    On flat ground u cos θ - v sin θ + δ = 1 - cos θ and V - Φ - ε tan θ N = tan θ, at one point.
    Half a wheel has v = Φ = 0 at both ends and V = 0 at the top; a whole ring closes, except for
    M, which closes only if the ground's force passes through the hub.
    """
    theta = float(points[first])
    sine, cosine, tangent = np.sin(theta), np.cos(theta), np.tan(theta)
    # after a spoke at the left edge, flatness holds at the start of the element
    begin, last = 6 * first, 6 * (len(points) - 1)
    delta = 6 * len(points)
    entries = [
        (0, begin, cosine),
        (0, begin + 1, -sine),
        (0, delta, 1.0),
        (1, begin + 4, 1.0),
        (1, begin + 2, -1.0),
        (1, begin + 3, -wheel.epsilon * tangent),
    ]
    right = [1 - cosine, tangent, 0.0, 0.0, 0.0, 0.0, 0.0]
    if wheel.spoke_angles is None:
        ends = [(2, 1), (3, 2), (4, last + 1), (5, last + 2), (6, last + 4)]
        return entries + [(row, column, 1.0) for row, column in ends], right
    for row, component in enumerate((0, 1, 2, 3, 4), 2):
        entries += [(row, component, -1.0), (row, last + component, 1.0)]
    return entries, right


def solve_ends(
    elements: Elements, jumps: Jumps, conditions: tuple[list[tuple[int, int, float]], list[float]]
) -> tuple[Floating, Floating, float]:
    """Join the elements: states before (n + 1, 6) and after (n, 6) their ends, and δ/R."""
    n = len(elements.end_map)
    across = np.zeros((n + 1, 6, 6)) + np.eye(6)
    across[:, 4, 0] += jumps.shear * jumps.slope
    across[:, 3, 0] += jumps.axial * jumps.slope
    constant = np.zeros((n + 1, 6))
    constant[:, 4] = jumps.shear * jumps.offset
    constant[:, 3] = jumps.axial * jumps.offset
    maps = elements.end_map @ across[:-1]
    vectors = np.einsum("nij,nj->ni", elements.end_map, constant[:-1]) + elements.end_vector
    row, column = np.indices((6, 6))
    first = 6 * np.arange(n)[:, None, None]
    extra = np.array(conditions[0])
    rows = np.concatenate([(first + row).ravel(), np.arange(6 * n), 6 * n + extra[:, 0]])
    columns = np.concatenate([(first + column).ravel(), np.arange(6, 6 * n + 6), extra[:, 1]])
    values = np.concatenate([-maps.ravel(), np.ones(6 * n), extra[:, 2]])
    size = 6 * (n + 1) + 1
    places = rows.astype(int), columns.astype(int)
    matrix = coo_array((values, places), shape=(size, size))
    solution = spsolve(matrix.tocsc(), np.concatenate([vectors.ravel(), conditions[1]]))
    before = solution[:-1].reshape(n + 1, 6)
    behind = np.einsum("nij,nj->ni", across[:-1], before[:-1]) + constant[:-1]
    return before, behind, float(solution[-1])
