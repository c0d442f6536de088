"""The model without units: lengths in R, forces in GA, moments in GA R.

Four numbers are left, for one design or for a table of them:
ε = GA/EA, κ² = GA R²/EI, and the foundations a_j = R² j/GA (compression) and
a_k = R² k/GA (tension). The ring's equations become first order in the angle θ:

    v' = ε N - u,   u' = V + v - Φ,   Φ' = κ² M,
    N' = -V - p_θ,  V' = N - p_r,     M' = V

with u = u_r/R, v = u_θ/R. On a free arc p_θ = 0 and p_r = -a u.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from nptcs.arrays import Floating, Mask, Rows


@dataclass(frozen=True)
class ScaledRing:
    """Dimensionless designs; each field has shape ``(n,)``.

    Parameters
    ----------
    epsilon : array
        ε = GA/EA.
    kappa2 : array
        κ² = GA R²/EI.
    compression, tension : array
        a_j and a_k.
    """

    epsilon: Floating
    kappa2: Floating
    compression: Floating
    tension: Floating

    def take(self, rows: Rows | Mask) -> ScaledRing:
        """Return the designs of some rows."""
        return ScaledRing(
            self.epsilon[rows], self.kappa2[rows], self.compression[rows], self.tension[rows]
        )

    def repeat(self, times: int) -> ScaledRing:
        """Return each design `times` times over, in blocks."""
        return ScaledRing(
            np.repeat(self.epsilon, times),
            np.repeat(self.kappa2, times),
            np.repeat(self.compression, times),
            np.repeat(self.tension, times),
        )
