"""One solved design: its numbers, and its state at any point of the ring."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
import pandas as pd
from numpy.typing import ArrayLike, NDArray

from nptcs.arrays import Floating
from nptcs.lca.linear.fields import compression_states, contact_states, tension_states
from nptcs.lca.linear.scaling import ScaledRing
from nptcs.lca.linear.system import Arcs, Joined
from nptcs.lca.section import ShearBandSection
from nptcs.lca.spokes.linear import LinearSpokes

REGIONS = ("contact", "compression", "tension")


@dataclass(frozen=True)
class LcaState:
    """Solution of the load-bearing model for one design.

    Parameters
    ----------
    section, spokes : ShearBandSection, LinearSpokes
        The design.
    displacement_mm, load_n : float
        Displacement δ of the hub and force F of the ground.
    theta_c_deg, theta_t_deg : float
        Contact and transition angle, from the centre of the contact.
    stiffness_n_per_mm, tangent_stiffness_n_per_mm : float
        Secant F/δ and tangent dF/dδ.
    contact_force_n, ring_force_n : float
        F_c, carried by the spokes of the contact region (equation 14), and F_nc, by the ring
        (equation 13).
    mean_pressure_mpa, lowest_pressure_mpa : float
        Mean and lowest contact pressure of ring and contact spokes together.
    balance_residual : float
        (F_nc - vertical sum of the spoke forces outside the contact region)/F, by quadrature.
    doubts : str
        Which of the model's assumptions the solution breaks; empty if none.
    """

    section: ShearBandSection
    spokes: LinearSpokes
    displacement_mm: float
    load_n: float
    theta_c_deg: float
    theta_t_deg: float
    stiffness_n_per_mm: float
    tangent_stiffness_n_per_mm: float
    contact_force_n: float
    ring_force_n: float
    mean_pressure_mpa: float
    lowest_pressure_mpa: float
    balance_residual: float
    doubts: str
    _ring: ScaledRing = field(repr=False)
    _arcs: Arcs = field(repr=False)
    _joined: Joined = field(repr=False)

    @property
    def contact_length_mm(self) -> float:
        """Length of the contact, 2 R θc, measured along the band."""
        return float(2 * self.section.radius_mm * np.radians(self.theta_c_deg))

    def at(self, theta_deg: ArrayLike) -> pd.DataFrame:
        """Return the state at angles from the centre of the contact, positive or negative.

        Parameters
        ----------
        theta_deg : array-like
            Angles (degrees); 0 is the centre of the contact, 180 the top.

        Returns
        -------
        DataFrame
            Columns ``theta_deg, region, u_r_mm, u_theta_mm, phi_rad, n_n, v_n, m_n_mm,
            pressure_mpa`` (of the ring) and ``spoke_pressure_mpa`` (of the contact spokes).
        """
        degrees = np.atleast_1d(np.asarray(theta_deg, dtype=float))
        wrapped = np.radians((degrees + 180.0) % 360.0 - 180.0)
        side, theta = np.where(wrapped < 0, -1.0, 1.0), np.abs(wrapped)
        region = np.searchsorted(
            [self._joined.contact_angle[0], self._joined.transition_angle[0]], theta
        )
        states, pressure = self._scaled_states(theta, region)
        shear, radius = self.section.shear_stiffness_n, self.section.radius_mm
        in_contact = region == 0
        _, j = self.spokes.foundation(radius)
        width = self.section.width_mm
        return pd.DataFrame(
            {
                "theta_deg": degrees,
                "region": np.array(REGIONS)[region],
                "u_r_mm": states[:, 0] * radius,
                "u_theta_mm": states[:, 1] * radius * side,
                "phi_rad": states[:, 2] * side,
                "n_n": states[:, 3] * shear,
                "v_n": states[:, 4] * shear * side,
                "m_n_mm": states[:, 5] * shear * radius,
                "pressure_mpa": pressure * shear / (width * radius),
                "spoke_pressure_mpa": np.where(in_contact, j * self.displacement_mm / width, 0.0),
            }
        )

    def _scaled_states(
        self, theta: Floating, region: NDArray[np.integer]
    ) -> tuple[Floating, Floating]:
        """States (points, 6) and pressure b R q/GA (zero outside the contact)."""
        states, pressure = np.empty((len(theta), 6)), np.zeros(len(theta))
        contact, near, far = (region == index for index in range(3))
        if contact.any():
            states[contact], pressure[contact] = contact_states(
                self._ring, self._joined, theta[contact]
            )
        if near.any():
            states[near] = compression_states(self._arcs, self._joined, theta[None, near])[0]
        if far.any():
            states[far] = tension_states(self._arcs, self._joined, theta[None, far])[0]
        return states, pressure
