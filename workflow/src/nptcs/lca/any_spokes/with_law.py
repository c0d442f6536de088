"""The load-bearing model with any spoke law, smeared or with single spokes."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import assert_never

import numpy as np
import pandas as pd
from scipy.interpolate import CubicHermiteSpline
from scipy.optimize import brentq

from nptcs.arrays import Floating
from nptcs.errors import InputError
from nptcs.lca.any_spokes.wheel import SAME_ANGLE, ContactSpokes, Edge, Pressed, Wheel, press_wheel
from nptcs.lca.batch import TARGETS, only_target
from nptcs.lca.checks import require_positive
from nptcs.lca.linear.diagnosis import LARGEST_RESIDUAL
from nptcs.lca.linear.newton import LARGEST_CONTACT
from nptcs.lca.section import ShearBandSection
from nptcs.lca.single import ModelError
from nptcs.lca.spokes.law import SpokeLaw

_ITERATIONS = 60
_STEADY = 1e-9
"""Relative change of displacement and force after which an iteration, whose error is of the order
of the change's square, has converged."""
_PAUSE = 0.03
"""Length that an edge's coordinate spends at a single spoke while the ground takes it over."""


@dataclass(frozen=True)
class LawState:
    """Solution for a spoke law.

    Parameters
    ----------
    section, law : ShearBandSection, SpokeLaw
        The design.
    contact : {"local", "paper"}
        How the contact region's spokes act, see `nptcs.lca.any_spokes.wheel`.
    hub_angle_deg : float or None
        Angle of the spoke nearest to the contact's centre, for single spokes.
    displacement_mm, load_n, stiffness_n_per_mm : float
        Displacement δ of the hub, force F of the ground and secant F/δ.
    contact_left_deg, contact_right_deg : float
        Ends of the contact.
    theta_t_deg : float
        First angle at which u_r is zero.
    contact_force_n, ring_force_n : float
        Vertical force of the contact region's spokes, and the rest.
    lowest_pressure_mpa : float
        Lowest contact pressure between spokes.
    elongation_mm : tuple of float
        Lowest and highest elongation of a spoke.
    balance_residual : float
        (F - vertical sum of all spoke forces)/F.
    doubts : str
        Which of the model's assumptions the solution breaks; empty if none.
    """

    section: ShearBandSection
    law: SpokeLaw
    contact: ContactSpokes
    hub_angle_deg: float | None
    displacement_mm: float
    load_n: float
    stiffness_n_per_mm: float
    contact_left_deg: float
    contact_right_deg: float
    theta_t_deg: float
    contact_force_n: float
    ring_force_n: float
    lowest_pressure_mpa: float
    elongation_mm: tuple[float, float]
    balance_residual: float
    doubts: str
    pressed: Pressed = field(repr=False)

    @property
    def theta_c_deg(self) -> float:
        """Half the contact's angle."""
        return (self.contact_right_deg - self.contact_left_deg) / 2

    def points(self) -> pd.DataFrame:
        """Return the state at all points of the mesh: half the wheel if spokes are smeared.

        Returns
        -------
        DataFrame
            ``theta_deg, u_r_mm, u_theta_mm, phi_rad, n_n, v_n, m_n_mm, pressure_mpa``.
        """
        pressed, section = self.pressed, self.section
        states = pressed.states[:, 1:-1].reshape(-1, 6)
        shear, radius = section.shear_stiffness_n, section.radius_mm
        return pd.DataFrame(
            {
                "theta_deg": np.degrees(pressed.theta.ravel()),
                "u_r_mm": states[:, 0] * radius,
                "u_theta_mm": states[:, 1] * radius,
                "phi_rad": states[:, 2],
                "n_n": states[:, 3] * shear,
                "v_n": states[:, 4] * shear,
                "m_n_mm": states[:, 5] * shear * radius,
                "pressure_mpa": pressed.pressure.ravel() * shear / (section.width_mm * radius),
            }
        )


class _Search:
    """Finds the edges for a target, each solution starting from the displacement of the last."""

    def __init__(self, wheel: Wheel) -> None:
        self.wheel = wheel
        self.start: CubicHermiteSpline | None = None

    def settle(self, left: Edge, right: Edge) -> Pressed:
        """Iterate the spokes' linearisation for given edges."""
        guess, last = self.start, (np.inf, np.inf)
        for _ in range(_ITERATIONS):
            pressed = press_wheel(self.wheel, left, right, guess)
            guess, now = pressed.field(), (pressed.sinking, pressed.force)
            if np.allclose(now, last, rtol=_STEADY, atol=0):
                self.start = guess
                return pressed
            last = now
        raise ModelError(
            "load-bearing model: the spokes' forces do not settle",
            remedy="smooth the spoke's curve, or give it fewer points",
            value=float(np.degrees(right.angle)),
        )

    def symmetric(self, coordinate: float) -> Pressed:
        """Solve for a contact of the same coordinate on both sides, its centre still free."""
        if self.wheel.spoke_angles is None:
            return self.settle(Edge(0.0), Edge(coordinate))
        return self._centred(coordinate)

    def _centred(self, half: float) -> Pressed:
        """Shift the contact of single spokes until the ground's force passes through the hub."""
        centred = self._at(half, 0.0)
        if abs(centred.hub_moment) <= 1e-12 * abs(centred.force):
            return centred
        reach = 0.999 * half

        def moment(shift: float) -> float:
            return self._at(half, shift).hub_moment

        if moment(-reach) * moment(reach) > 0:
            raise ModelError(
                "load-bearing model: no contact around the hub's vertical balances the wheel",
                remedy="use another hub angle or load",
                value=float(np.degrees(half)),
            )
        shift = brentq(moment, -reach, reach, xtol=1e-13, rtol=1e-13)
        return self._at(half, shift)

    def _at(self, half: float, shift: float) -> Pressed:
        angles = self.wheel.spoke_angles
        assert angles is not None
        left = edge_at(half - shift, np.sort(-angles[angles < -SAME_ANGLE]))
        right = edge_at(half + shift, np.sort(angles[angles > SAME_ANGLE]))
        return self.settle(Edge(-left.angle, left.share), right)


def edge_at(coordinate: float, spokes: Floating) -> Edge:
    """Return the edge of a coordinate that grows with the contact and pauses at each spoke.

    Parameters
    ----------
    coordinate : float
        Above zero.
    spokes : array
        Angles of the single spokes on this side (radians), increasing.
    """
    arrival = spokes + _PAUSE * np.arange(len(spokes))
    passed = int(np.sum(arrival + _PAUSE <= coordinate))
    if passed < len(spokes) and coordinate > arrival[passed]:
        return Edge(float(spokes[passed]), float((coordinate - arrival[passed]) / _PAUSE))
    angle = coordinate - passed * _PAUSE
    behind = passed > 0 and angle - spokes[passed - 1] < 2 * SAME_ANGLE
    return Edge(float(angle), 1.0 if behind else 0.0)


def solve_law(
    section: ShearBandSection,
    law: SpokeLaw,
    *,
    load_n: float | None = None,
    displacement_mm: float | None = None,
    theta_c_deg: float | None = None,
    contact: ContactSpokes = "local",
    hub_angle_deg: float | None = None,
) -> LawState:
    """Solve the load-bearing model with spokes that follow a curve.

    Parameters
    ----------
    section, law : ShearBandSection, SpokeLaw
        The design.
    load_n, displacement_mm, theta_c_deg : float
        Exactly one of them; `theta_c_deg` for smeared spokes only.
    contact : {"local", "paper"}
        Spokes of the contact region at their local displacement, or all shortened by δ as in
        equation 14 (smeared spokes only).
    hub_angle_deg : float, optional
        If given, the spokes are single, one of them at this angle from the contact's centre.

    Raises
    ------
    InputError
        The target or the combination of options makes no sense.
    ModelError
        The target cannot be reached, or a spoke is stretched or compressed beyond its curve.

    Examples
    --------
    Spokes that follow two straight lines, as in equation 14, are those of `nptcs.lca.single.solve`:

    >>> from nptcs.config.solvers.tyre import TyreGeometry
    >>> from nptcs.lca.spokes.linear import LinearSpokes
    >>> ring = ShearBandSection.from_tyre(TyreGeometry(), c10_mpa=5.0)
    >>> law = SpokeLaw.linear(LinearSpokes(30.2, 13.26), reach_mm=50)
    >>> round(solve_law(ring, law, load_n=5000, contact="paper").displacement_mm, 2)
    20.74
    """
    name, raw = only_target(load_n, displacement_mm, theta_c_deg)
    target = float(np.asarray(raw))
    require_positive(name, target)
    if hub_angle_deg is not None and (contact == "paper" or name == "theta_c_deg"):
        raise InputError(
            "single spokes act at their local displacement, and their contact is not symmetric",
            remedy="give a load or a displacement, and contact='local'",
            column="hub_angle_deg",
            value=hub_angle_deg,
        )
    wheel = Wheel(section, law, contact, _spoke_angles(law.count, hub_angle_deg))
    search = _Search(wheel)
    kind = TARGETS[name]
    match kind:
        case "contact_angle":
            pressed = search.symmetric(float(np.radians(target)))
        case "force":
            pressed = _reach(search, kind, target / section.shear_stiffness_n)
        case "sinking":
            pressed = _reach(search, kind, target / section.radius_mm)
        case _:
            assert_never(kind)
    state = _state(wheel, hub_angle_deg, pressed)
    _refuse(state)
    return state


def _spoke_angles(count: int, hub_angle_deg: float | None) -> Floating | None:
    """Angles of single spokes on -π…π (radians), increasing."""
    if hub_angle_deg is None:
        return None
    spacing = 2 * np.pi / count
    first = np.radians(hub_angle_deg) % spacing
    angles = first + spacing * np.arange(count)
    return np.asarray(np.sort(np.where(angles > np.pi, angles - 2 * np.pi, angles)))


def _reach(search: _Search, quantity: str, target: float) -> Pressed:
    """Find the contact at which F/GA or δ/R has its target; both grow with the contact."""

    def misfit(coordinate: float) -> float:
        return float(getattr(search.symmetric(coordinate), quantity)) / target - 1

    low = high = float(np.arctan(target / 4 if quantity == "force" else target))
    while misfit(high) < 0:
        low, high = high, 1.5 * high
        if high > LARGEST_CONTACT:
            raise ModelError(
                "load-bearing model: no contact below 85 degrees reaches the target",
                remedy="give a smaller load or displacement",
            )
    while misfit(low) > 0:
        low, high = low / 2, low
        if low < 1e-9:
            raise ModelError(
                "load-bearing model: the target is below what the smallest contact carries",
                remedy="give a larger load or displacement",
            )
    return search.symmetric(float(brentq(misfit, low, high, xtol=1e-15, rtol=1e-13)))


def _state(wheel: Wheel, hub_angle_deg: float | None, pressed: Pressed) -> LawState:
    """Turn a solution into N, mm, MPa and degrees."""
    section = wheel.section
    shear, radius = section.shear_stiffness_n, section.radius_mm
    left = -pressed.right.angle if wheel.spoke_angles is None else pressed.left.angle
    load, displacement = pressed.force * shear, pressed.sinking * radius
    contact_force = pressed.contact_force * shear
    zeros = pressed.field().solve(0.0, extrapolate=False)
    crossing = zeros[zeros > pressed.right.angle]
    pressure = pressed.pressure[pressed.in_contact].min() * shear / (section.width_mm * radius)
    if wheel.passes_by:
        width = 2 * pressed.right.angle * radius * section.width_mm
        pressure += contact_force / width
    doubts = "the ground would have to pull" if pressure < 0 else ""
    return LawState(
        section,
        wheel.law,
        wheel.contact,
        hub_angle_deg,
        displacement,
        load,
        load / displacement,
        float(np.degrees(left)),
        float(np.degrees(pressed.right.angle)),
        float(np.degrees(crossing[0])) if len(crossing) else float("nan"),
        contact_force,
        load - contact_force,
        float(pressure),
        _elongations(wheel, pressed),
        pressed.balance_residual,
        doubts,
        pressed,
    )


def _elongations(wheel: Wheel, pressed: Pressed) -> tuple[float, float]:
    """Lowest and highest elongation of a spoke (mm)."""
    radius = wheel.section.radius_mm
    u: Floating
    if wheel.spoke_angles is not None:
        u = pressed.field()(wheel.spoke_angles)
    elif wheel.passes_by:
        u = np.append(pressed.states[~pressed.in_contact][..., 0].ravel(), -pressed.sinking)
    else:
        u = pressed.states[..., 0]
    return float(u.min() * radius), float(u.max() * radius)


def _refuse(state: LawState) -> None:
    """Raise `ModelError` if the balance is not met or a spoke leaves the range of its curve."""
    if not abs(state.balance_residual) < LARGEST_RESIDUAL:
        raise ModelError(
            "load-bearing model: the ground's and the spokes' forces do not balance",
            remedy="give the spoke's curve fewer points, or check the ring's stiffness",
            value=state.balance_residual,
        )
    for reached, limit, way in zip(
        state.elongation_mm, state.law.range_mm, ("compressed", "stretched"), strict=True
    ):
        if abs(reached) > abs(limit) and reached * limit > 0:
            raise ModelError(
                f"load-bearing model: spokes are {way} by {abs(reached):.4g} mm, their curve ends "
                f"at {abs(limit):.4g} mm",
                remedy="give a curve that reaches further, or a smaller load",
            )


def stiffness_ripple(
    section: ShearBandSection, law: SpokeLaw, load_n: float, hub_angles_deg: Floating
) -> pd.DataFrame:
    """Return displacement and stiffness against the hub's angle, for single spokes.

    Parameters
    ----------
    section, law : ShearBandSection, SpokeLaw
        The design.
    load_n : float
        Load (N).
    hub_angles_deg : array
        Angles of a spoke from the contact's centre (degrees).
    """
    states = [
        solve_law(section, law, load_n=load_n, hub_angle_deg=float(angle))
        for angle in hub_angles_deg
    ]
    columns = ("displacement_mm", "stiffness_n_per_mm", "contact_left_deg", "contact_right_deg")
    table = {name: [getattr(state, name) for state in states] for name in columns}
    return pd.DataFrame({"hub_angle_deg": np.asarray(hub_angles_deg, dtype=float), **table})
